/// Numbers with units. The first line is a number and a unit: where both are read the number is what the C
/// library makes of it, and goes to CGS and back within rounding. A directive of each kind takes or refuses
/// the line.

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "core/base/lines.hpp"
#include "core/base/number.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/units.hpp"
#include "validation/fuzz/target.hpp"

namespace treejet::fuzz {

namespace {

void check_printable(const std::string& message) {
  for (const char c : message)
    demand(c == '\n' || (c >= ' ' && c <= '~'), "a message is printable: " + message);
}

/// In the spelling of C: the letter of an exponent is e, and goes with its exponent.
std::string c_spelling(std::string word) {
  for (char& c : word)
    if (c == 'd' || c == 'D' || c == 'E') c = 'e';
  if (!word.empty() && word.back() == 'e') word.pop_back();
  return word;
}

void read_number(const std::string& word) {
  demand(number_length(word) <= word.size(), "a number is no longer than its word");
  const Reading<int> whole = integer(word);
  const Reading<double> real = real_number(word);
  check_printable(real.problem);
  check_printable(whole.problem);
  check_printable(treejet::quoted(word));
  if (!real.problem.empty()) return demand(!whole.problem.empty(), "an integer is a real number");
  const std::string spelling = c_spelling(word);
  char* end = nullptr;
  const double expected = std::strtod(spelling.c_str(), &end);
  demand(*end == '\0' && real.value == expected && std::isfinite(expected), "a number is what C makes of it");
  if (whole.problem.empty()) demand(whole.value == expected, "an integer is a real number");
}

void read_unit(const std::string& text) {
  const std::optional<Unit> given = unit(text);
  if (!given) return;
  check_printable(quantity_name(given->dimension));
  usual_units(given->dimension);
  const Unit cgs{given->dimension, 1, 1};
  const double factor = converted(1, *given, cgs), back = converted(factor, cgs, *given);
  demand(std::isfinite(factor) && factor > 0, "a unit is so many of CGS: " + text);
  demand(std::abs(back - 1) < 1e-14, "there and back is the same: " + text);  // two quotients and products
}

/// One directive of each type and unit.
const std::vector<const Directive*>& kinds() {
  static const std::vector<const Directive*> all = [] {
    std::map<std::pair<std::size_t, std::string_view>, const Directive*> kinds;
    for (const Directive& d : directives()) kinds.try_emplace({d.member.index(), d.unit}, &d);
    std::vector<const Directive*> one_of_each;
    for (const auto& [kind, d] : kinds) one_of_each.push_back(d);
    return one_of_each;
  }();
  return all;
}

}  // namespace

std::vector<std::string> quantities() {
  std::vector<std::string> all{
      "1.d-8",     "20.",       "-3 mN/m",      "0.5 g/(cm s)",         "4 kg m^-3",
      "10000.d",   "1e5\tPa*s", "2 (kg/m3)**2", "+.5E+2 \xc2\xb5L/min", "7 cm\xc2\xb2\xc2\xb7s-1",
      "1x10^4 kV", "20.cm"};
  for (const Directive& d : directives())
    if (!d.unit.empty()) all.push_back("1.5 " + std::string(d.unit));
  return all;
}

void feed_quantity(std::string_view bytes) {
  const auto lines = lines_of(bytes);
  const std::string line(lines.empty() ? "" : lines.front());
  const std::vector<std::string> words = words_of(line);
  for (const std::string& word : words) read_number(word);
  if (words.empty()) return read_unit(line);
  const std::size_t behind = line.find(words[0]) + words[0].size();
  read_unit(line.substr(std::min(line.find_first_not_of(" \t", behind), line.size())));
  read_unit(words[0]);
  for (const Directive* d : kinds()) {
    Parameters p;
    check_printable(assign(*d, words, p));
    value_text(*d, p);
  }
}

}  // namespace treejet::fuzz
