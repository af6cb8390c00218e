#include "core/io/hdf5_table.hpp"

#include <fmt/ranges.h>
#include <hdf5.h>

#include <cstring>

namespace treejet::hdf5 {

namespace {

TableBox box_of(const Extent& place, const Extent& chunk) {
  Extent first = place;
  for (std::size_t k = 0; k < first.size(); ++k) first[k] *= chunk[k];
  return {first, chunk};
}

std::size_t count(const TableBox& box) {
  std::size_t values = 1;
  for (const auto n : box.size) values *= n;
  return values;
}

}  // namespace

template <class T>
void TableReader<T>::read_plain(const TableBox& box, const Extent& chunk, T* values, T absent) const {
  std::vector<TableBox> parts = {box};
  if (!chunk.empty())
    parts = parts_there(box, chunk,
                        [&](const Extent& place) { return chunk_bytes(box_of(place, chunk).first) > 0; });
  const std::vector<hsize_t> size(box.size.begin(), box.size.end());
  if (parts != std::vector{box}) std::fill_n(values, count(box), absent);
  const Handle space(check_(H5Dget_space(set_), "cannot be read"), H5Sclose);
  const Handle memory(check_(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), "space"),
                      H5Sclose);
  for (const TableBox& part : parts) {
    Extent in_memory = part.first;
    for (std::size_t k = 0; k < in_memory.size(); ++k) in_memory[k] -= box.first[k];
    select(space, part);
    select(memory, {in_memory, part.size});
    check_(H5Dread(set_, type_, memory, space, H5P_DEFAULT, values), "cannot be read");
  }
}

template <class T>
void TableReader<T>::read_filtered(const TableBox& box, const Extent& chunk,
                                   std::span<const ChunkFilter> filters, std::uint64_t length, T* values,
                                   T absent) const {
  const Handle stored(check_(H5Dget_type(set_), "cannot be read"), H5Tclose);
  static_assert(sizeof(T) == sizeof(std::uint64_t), "no number that is stored is wider");
  std::vector<T> numbers;
  std::fill_n(values, count(box), absent);
  for_each_place(chunks_touched_by(box, chunk), [&](const Extent& place) {
    const TableBox own = box_of(place, chunk);
    unsigned skipped = 0;
    const std::string bytes = filtered(own.first, skipped);
    if (bytes.empty()) return;
    const auto plain = unfiltered(bytes, filters, skipped, length);
    if (!plain)
      refuse(path_, name_,
             fmt::format("is damaged: its chunk at {} is not {} bytes of values", fmt::join(own.first, ", "),
                         length));
    numbers.resize(length / H5Tget_size(stored));
    std::memcpy(numbers.data(), plain->data(), length);
    check_(H5Tconvert(stored, type_, numbers.size(), numbers.data(), nullptr, H5P_DEFAULT), "cannot be read");
    copy_shared(own, numbers.data(), box, values);
  });
}

template <class T>
void TableReader<T>::select(Id space, const TableBox& part) const {
  const std::vector<hsize_t> first(part.first.begin(), part.first.end()),
      size(part.size.begin(), part.size.end());
  check_(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr),
         "selection");
}

template <class T>
std::uint64_t TableReader<T>::chunk_bytes(const Extent& first) const {
  const std::vector<hsize_t> at(first.begin(), first.end());
  hsize_t bytes = 0;
  if (H5Dget_chunk_storage_size(set_, at.data(), &bytes) < 0 && reason() != "chunk storage is not allocated")
    check_(-1, "cannot be read");
  return bytes;
}

template <class T>
std::string TableReader<T>::filtered(const Extent& first, unsigned& skipped) const {
  const std::uint64_t length = chunk_bytes(first);
  if (length == 0) return {};
  std::error_code error;
  if (length > std::filesystem::file_size(path_, error))
    refuse(path_, name_, "is damaged: a chunk is longer than the file");
  std::string bytes(length, '\0');
  const std::vector<hsize_t> at(first.begin(), first.end());
  check_(H5Dread_chunk(set_, H5P_DEFAULT, at.data(), &skipped, bytes.data()), "cannot be read");
  return bytes;
}

template class TableReader<double>;
template class TableReader<std::int64_t>;

}  // namespace treejet::hdf5
