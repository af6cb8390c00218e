#include "validation/fuzz/mutation.hpp"

#include <algorithm>
#include <cstring>

namespace treejet::fuzz {

std::string Mutator::next() {
  std::string bytes = seed();
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(bytes);
  return bytes;
}

void Mutator::change(std::string& bytes) {
  const std::size_t at = below(bytes.size()), length = std::min(bytes.size() - at, below(64));
  switch (below(8)) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      if (!bytes.empty()) bytes[at] = static_cast<char>(random_());
      break;
    case 2:
    case 3:
      put_number(bytes, at);
      break;
    case 4:
      bytes.erase(at, length);
      break;
    case 5:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 6:
      bytes.resize(at);
      break;
    default:
      splice(bytes, at);
  }
}

/// In the place of digits in digits, else in binary, of any width.
void Mutator::put_number(std::string& bytes, std::size_t at) {
  constexpr std::int64_t numbers[] = {0,
                                      1,
                                      -1,
                                      2,
                                      127,
                                      255,
                                      65535,
                                      1 << 20,
                                      2147483647,
                                      -2147483648,
                                      4294967296,
                                      9223372036854775807,
                                      -9223372036854775807 - 1};
  const std::int64_t number = numbers[below(std::size(numbers))];
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto first = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), is_digit);
  if (below(2) == 0 && first != bytes.end()) {
    bytes.replace(first, std::find_if_not(first, bytes.end(), is_digit), std::to_string(number));
    return;
  }
  const std::size_t width = std::size_t(1) << below(4), aligned = below(2) == 0 ? at / width * width : at;
  if (aligned + width <= bytes.size()) std::memcpy(bytes.data() + aligned, &number, width);
}

void Mutator::splice(std::string& bytes, std::size_t at) {
  const std::string& other = seed();
  const std::size_t from = below(other.size()), length = std::min(other.size() - from, below(256));
  if (below(2) == 0)
    bytes.insert(at, other, from, length);
  else
    bytes.replace(at, std::min(length, bytes.size() - at), other, from, length);
}

}  // namespace treejet::fuzz
