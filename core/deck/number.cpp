#include "core/deck/number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace treejet {

namespace {

constexpr std::size_t longest_word_worth_mending = 40;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_sign(char c) {
  return c == '+' || c == '-';
}

std::size_t digits_from(std::string_view word, std::size_t i) {
  while (i < word.size() && is_digit(word[i])) ++i;
  return i;
}

/// The number as std::from_chars reads it; empty if the word is not a number.
std::string c_notation(std::string_view word) {
  const std::size_t begin = !word.empty() && is_sign(word[0]) ? 1 : 0;
  std::size_t i = digits_from(word, begin);
  std::size_t digits = i - begin;
  if (i < word.size() && word[i] == '.') {
    const std::size_t after_dot = i + 1;
    i = digits_from(word, after_dot);
    digits += i - after_dot;
  }
  if (digits == 0) return {};
  std::string number(word.substr(word[0] == '+' ? 1 : 0, i - (word[0] == '+' ? 1 : 0)));
  if (i == word.size()) return number;
  if (std::string_view("dDeE").find(word[i]) == std::string_view::npos) return {};
  if (++i == word.size()) return number;
  const std::string exponent(word.substr(i));
  if (is_sign(word[i])) ++i;
  if (i == word.size() || digits_from(word, i) != word.size()) return {};
  return number + 'e' + exponent;
}

/// The well-formed number one slip of the pen away, or the one the word begins with; empty if there is none.
std::string mended(std::string_view word) {
  if (word.size() > longest_word_worth_mending) return {};
  const auto well_formed = [](const std::string& s) { return !c_notation(s).empty(); };
  for (std::size_t i = word.size(); i-- > 0;) {
    std::string candidate(word);
    if (word[i] == ',') candidate[i] = '.';
    if (is_sign(word[i]) && i > 0) candidate.insert(i, 1, 'd');
    if (well_formed(candidate)) return candidate;
  }
  for (std::size_t i = word.size(); i-- > 0;) {
    std::string candidate(word);
    if (well_formed(candidate.erase(i, 1))) return candidate;
  }
  for (std::size_t length = word.size(); length-- > 0;)
    if (const std::string candidate(word.substr(0, length)); well_formed(candidate)) return candidate;
  return {};
}

std::string not_a_number(std::string_view word) {
  const std::string nearest = mended(word);
  return fmt::format("found {}{}", quoted(word),
                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

bool spells_no_finite_number(std::string_view word) {
  if (!word.empty() && is_sign(word[0])) word.remove_prefix(1);
  for (const std::string_view name : {"nan", "inf", "infinity"})
    if (word == name) return true;
  return false;
}

}  // namespace

std::string quoted(std::string_view word) {
  std::string shown;
  for (const char c : word.substr(0, longest_word_worth_mending)) {
    if (c >= ' ' && c <= '~')
      shown += c;
    else
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return fmt::format("'{}{}'", shown, word.size() > longest_word_worth_mending ? "..." : "");
}

Reading<double> real_number(std::string_view word) {
  if (spells_no_finite_number(word)) return {0, fmt::format("found {}, which is not finite", quoted(word))};
  const std::string number = c_notation(word);
  if (number.empty()) return {0, not_a_number(word)};
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  const bool names_zero = number.find_first_of("123456789") >= number.find('e');
  if (!names_zero && (error == std::errc::result_out_of_range || value == 0 || !std::isfinite(value)))
    return {0, fmt::format("found {}, which is beyond the range of double precision", quoted(word))};
  return {names_zero ? 0 : value};
}

Reading<int> integer(std::string_view word) {
  const std::string_view digits = !word.empty() && word[0] == '+' ? word.substr(1) : word;
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool well_formed = error != std::errc::invalid_argument && end == digits.data() + digits.size();
  if (well_formed && error == std::errc{} && (word[0] != '+' || is_digit(digits[0]))) return {value};
  if (well_formed && error == std::errc::result_out_of_range)
    return {0, fmt::format("found {}, which is beyond the range of an integer", quoted(word))};
  const Reading<double> real = real_number(word);
  const bool whole = real.problem.empty() && real.value == std::round(real.value) &&
                     std::abs(real.value) < std::numeric_limits<int>::max();
  return {0, fmt::format("found {}{}", quoted(word),
                         whole ? fmt::format("; did you mean {:.0f}?", real.value) : "")};
}

}  // namespace treejet
