#include "core/base/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <regex>
#include <vector>

#include "core/base/lines.hpp"

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

struct Slip {
  std::regex written;
  std::string meant;  ///< empty: more than one number could be meant
  std::string said = {};
};

/// Ways to spell a number that are not ours. None changes its magnitude.
const std::vector<Slip>& slips() {
  const auto pattern = [](const char* text) { return std::regex(text, std::regex::icase); };
  static const std::vector<Slip> all = {
      {pattern("[^,]*,[0-9]{3}(|[^0-9].*)|.*,.*,.*"), "",
       ": a comma groups digits for some and begins decimals for others; write a decimal point, and nothing "
       "between thousands"},
      {pattern("([-+]?[0-9]*),([0-9]*)(|d.*|e.*)"), "$1.$2$3"},
      {pattern("([-+]?[0-9.]+)([-+][0-9]+)"), "$1d$2"},    // Fortran's 1.0-8
      {pattern("([-+]?[0-9.]+)q([-+]?[0-9]+)"), "$1d$2"},  // quadruple precision
      {pattern("([-+]?[0-9.]+)[x*]10(\\^|\\*\\*)([-+]?[0-9]+)"), "$1d$3"},
      {pattern("([-+]?[0-9]*)\\.\\.+([0-9]*.*)"), "$1.$2"},
      {pattern("([-+]?[0-9]*\\.[0-9]*)\\.([de].*)"), "$1$2"},  // 0.02.d0
      {pattern("([-+]?[0-9.]+[de][-+]?[0-9]+)\\."), "$1"},
      {pattern("([-+]?[0-9]+)_([0-9]+)"), "$1$2"},
  };
  return all;
}

/// The word with ASCII's minus where a typographic one stands: U+2212, or the dashes U+2010 to U+2014.
std::string with_ascii_minus(std::string_view word) {
  std::string plain;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const std::string_view three = word.substr(i, 3);
    const bool dash =
        three.starts_with("\xe2\x80") && three.size() == 3 && three[2] >= '\x90' && three[2] <= '\x94';
    const bool minus = dash || three == "\xe2\x88\x92";
    plain += minus ? '-' : word[i];
    if (minus) i += 2;
  }
  return plain;
}

std::string meant(const std::string& number) {
  return c_notation(number).empty() ? "" : fmt::format("; did you mean {}?", number);
}

std::string not_a_number(std::string_view word) {
  const std::string found = "found " + quoted(word);
  if (word.size() > longest_word_worth_mending) return found;
  const std::string plain = with_ascii_minus(word);
  if (plain != word)
    return fmt::format("{}, where a minus or dash is not the one of the keyboard (U+2212 or the like){}",
                       found, meant(plain));
  for (const Slip& slip : slips()) {
    if (!std::regex_match(plain, slip.written)) continue;
    return found +
           (slip.meant.empty() ? slip.said : meant(std::regex_replace(plain, slip.written, slip.meant)));
  }
  return found;
}

bool spells_no_finite_number(std::string_view written) {
  std::string word = lower_case(written);
  if (!word.empty() && is_sign(word[0])) word.erase(0, 1);
  for (const std::string_view name : {"nan", "inf", "infinity"})
    if (word == name) return true;
  return false;
}

}  // namespace

std::string quoted(std::string_view word) {
  std::string shown;
  for (const char c : word.substr(0, longest_word_worth_mending)) {
    if (is_printable(c))
      shown += c;
    else
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return fmt::format("'{}{}'", shown, word.size() > longest_word_worth_mending ? "..." : "");
}

std::size_t number_length(std::string_view word) {
  std::size_t length = std::min(word.size(), longest_word_worth_mending);
  while (length > 0 && c_notation(word.substr(0, length)).empty()) --length;
  return length;
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
