#include "core/io/frame.hpp"

#include <algorithm>

namespace treejet {

FrameColumns frame_columns(const FrameColumns& added) {
  FrameColumns all{
      {"position", "cm", 3}, {"velocity", "cm s-1", 3}, {"stress", "g cm-1 s-2"}, {"charge", "statC"},
      {"mass", "g"},         {"radius", "cm"}};
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

std::size_t bytes_of_point(const FrameColumns& columns) {
  std::size_t bytes = sizeof(std::int64_t);
  for (const FrameColumn& c : columns) bytes += sizeof(double) * static_cast<std::size_t>(c.width);
  return bytes;
}

FrameColumns frame_columns_of(const Columns& added) {
  FrameColumns columns;
  for (const Column& c : added) columns.push_back({c.name, c.unit});
  return columns;
}

bool is_column_name(const std::string& name) {
  const std::string letters = "abcdefghijklmnopqrstuvwxyz", others = "_0123456789";
  return !name.empty() && letters.find(name[0]) != std::string::npos &&
         name.find_first_not_of(letters + others) == std::string::npos;
}

}  // namespace treejet
