#include "core/deck/lines.hpp"

#include <algorithm>

namespace treejet {

std::vector<std::string_view> lines_of(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
    if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
  }
  return lines;
}

std::vector<std::string> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\v\f\r\n";
  line = line.substr(0, line.find_first_of("#!"));
  std::vector<std::string> words;
  for (std::size_t i = line.find_first_not_of(blanks); i != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, i), line.size());
    std::string& word = words.emplace_back(line.substr(i, end - i));
    for (char& c : word)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    i = line.find_first_not_of(blanks, end);
  }
  return words;
}

}  // namespace treejet
