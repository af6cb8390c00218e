#include "core/deck/units.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

namespace treejet {

namespace {

struct Symbol {
  std::string_view text;
  Dimension dimension;
  double numerator = 1, denominator = 1;
  bool prefixed = false;
};

constexpr double statcoulombs = 2997924580;  // of a coulomb

// clang-format off
constexpr Symbol symbols[] = {
    {"m", {.length = 1}, 100, 1, true},
    {"g", {.mass = 1}, 1, 1, true},
    {"s", {.time = 1}, 1, 1, true},
    {"min", {.time = 1}, 60},
    {"h", {.time = 1}, 3600},
    {"L", {.length = 3}, 1000, 1, true},
    {"l", {.length = 3}, 1000, 1, true},
    {"N", {1, 1, -2}, 1e5, 1, true},
    {"dyn", {1, 1, -2}},
    {"dyne", {1, 1, -2}},
    {"J", {2, 1, -2}, 1e7, 1, true},
    {"erg", {2, 1, -2}},
    {"Pa", {-1, 1, -2}, 10, 1, true},
    {"bar", {-1, 1, -2}, 1e6, 1, true},
    {"P", {-1, 1, -1}, 1, 1, true},
    {"poise", {-1, 1, -1}},
    {"C", {.charge = 1}, statcoulombs, 1, true},
    {"statC", {.charge = 1}},
    {"A", {.time = -1, .charge = 1}, statcoulombs, 1, true},
    {"statA", {.time = -1, .charge = 1}},
    {"V", {2, 1, -2, -1}, 1e7, statcoulombs, true},
    {"statV", {2, 1, -2, -1}},
    {"rad", {.angle = 1}},
    {"Hz", {.time = -1, .angle = 1}, 2 * std::numbers::pi, 1, true},
};

struct Prefix {
  std::string_view text;
  double numerator, denominator;
};
constexpr Prefix prefixes[] = {
    {"f", 1, 1e15}, {"p", 1, 1e12}, {"n", 1, 1e9}, {"u", 1, 1e6}, {"\u00b5", 1, 1e6}, {"\u03bc", 1, 1e6},
    {"m", 1, 1e3},  {"c", 1, 1e2},  {"d", 1, 10},  {"h", 1e2, 1}, {"k", 1e3, 1},      {"M", 1e6, 1},
    {"G", 1e9, 1},
};

struct Quantity {
  Dimension dimension;
  std::string_view name, usual;
};
constexpr Quantity quantities[] = {
    {{}, "a number without unit", ""},
    {{.length = 1}, "a length", "um, mm, cm, m"},
    {{.mass = 1}, "a mass", "mg, g"},
    {{.time = 1}, "a time", "us, ms, s"},
    {{.length = 2}, "an area", "mm2"},
    {{.length = 3}, "a volume", "mL"},
    {{.length = 1, .time = -1}, "a velocity", "mm/s, cm/s, m/s"},
    {{.length = 1, .time = -2}, "an acceleration", "m/s2"},
    {{.length = 2, .time = -2}, "a squared velocity", "m2/s2, cm2/s2"},
    {{.length = 2, .time = -3}, "a squared velocity over time", "m2/s3, cm2/s3"},
    {{.length = 2, .time = -1}, "a kinematic viscosity or diffusivity", "mm2/s, cm2/s"},
    {{.length = 3, .time = -1}, "a flow rate", "mL/h, uL/min"},
    {{-3, 1}, "a mass density", "kg/m3, g/cm3"},
    {{.length = -3, .charge = 1}, "a charge density", "C/m3, mC/L, statC/cm3"},
    {{.charge = 1}, "a charge", "nC, statC"},
    {{.time = -1, .charge = 1}, "a current", "nA, uA"},
    {{-1, 1, -1}, "a dynamic viscosity", "Pa s, mPa s, P"},
    {{-1, 1, -2}, "a pressure, stress or modulus", "Pa, kPa, MPa"},
    {{0, 1, -2}, "a surface tension", "mN/m, dyn/cm"},
    {{1, 1, -2}, "a force", "uN, dyn"},
    {{2, 1, -2}, "an energy", "J, erg"},
    {{2, 1, -2, -1}, "a potential", "V, kV, statV"},
    {{1, 1, -2, -1}, "an electric field", "kV/cm"},
    {{.time = -1}, "a rate", "1/s"},
    {{.time = -1, .angle = 1}, "an angular frequency", "rad/s, Hz, kHz"},
    {{.angle = 1}, "an angle", "rad"},
};
// clang-format on

constexpr std::size_t longest = 60;
constexpr int highest_power = 9;

std::optional<Unit> symbol(std::string_view text) {
  for (const Symbol& s : symbols)
    if (s.text == text) return Unit{s.dimension, s.numerator, s.denominator};
  for (const Prefix& p : prefixes) {
    if (!text.starts_with(p.text)) continue;
    for (const Symbol& s : symbols)
      if (s.prefixed && s.text == text.substr(p.text.size()))
        return Unit{s.dimension, s.numerator * p.numerator, s.denominator * p.denominator};
  }
  return std::nullopt;
}

Unit product(Unit a, const Unit& b, int power) {
  Dimension& d = a.dimension;
  const Dimension& e = b.dimension;
  d = {d.length + power * e.length, d.mass + power * e.mass, d.time + power * e.time,
       d.charge + power * e.charge, d.angle + power * e.angle};
  const double numerator = power > 0 ? b.numerator : b.denominator;
  const double denominator = power > 0 ? b.denominator : b.numerator;
  for (int i = 0; i < std::abs(power); ++i) a.numerator *= numerator, a.denominator *= denominator;
  return a;
}

/// unit = factor {("*" | blank | "/") factor}; factor = ("1" | symbol | "(" unit ")") [power].
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : rest_(text) {}

  std::optional<Unit> whole() {
    const std::optional<Unit> u = product_of_factors();
    return rest_.empty() ? u : std::nullopt;
  }

 private:
  std::optional<Unit> product_of_factors() {
    skip_blanks();
    std::optional<Unit> all = factor();
    for (bool divided = false; all && !at_end();) {
      const bool divides = taken("/"), multiplies = !divides && (taken("*") || taken("\u00b7"));
      if (divided && !divides) return std::nullopt;  // g/cm s: is s above or below?
      if (!divides && !multiplies && !blank_) return std::nullopt;
      divided |= divides;
      skip_blanks();
      const std::optional<Unit> next = factor();
      if (!next) return std::nullopt;
      all = product(*all, *next, divides ? -1 : 1);
    }
    return all;
  }

  std::optional<Unit> factor() {
    std::optional<Unit> base;
    if (taken("(")) {
      base = ++depth_ < 4 ? product_of_factors() : std::nullopt;
      if (!taken(")")) return std::nullopt;
      --depth_;
    } else if (taken("1")) {
      base = Unit{};
    } else {
      base = symbol(letters());
    }
    if (!base) return std::nullopt;
    const std::optional<int> exponent = power();
    return exponent ? std::optional(product({}, *base, *exponent)) : std::nullopt;
  }

  std::string_view letters() {
    std::size_t end = 0;
    const auto is_letter = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    };
    while (end < rest_.size() && is_letter(rest_[end]) && !rest_.substr(end).starts_with("\u00b2") &&
           !rest_.substr(end).starts_with("\u00b3") && !rest_.substr(end).starts_with("\u00b7"))
      ++end;
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }

  /// 1 without one.
  std::optional<int> power() {
    if (taken("\u00b2")) return 2;
    if (taken("\u00b3")) return 3;
    const bool marked = taken("**") || taken("^");
    int value = 1;
    const auto [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (failure == std::errc::result_out_of_range || value == 0 || value < -highest_power ||
        value > highest_power)
      return std::nullopt;
    if (failure != std::errc()) return marked ? std::nullopt : std::optional(1);
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  bool at_end() {
    blank_ = skip_blanks();
    return rest_.empty() || rest_.front() == ')';
  }

  bool skip_blanks() {
    const std::size_t before = rest_.size();
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    return rest_.size() < before;
  }

  bool taken(std::string_view mark) {
    const bool there = rest_.starts_with(mark);
    if (there) rest_.remove_prefix(mark.size());
    return there;
  }

  std::string_view rest_;
  bool blank_ = false;  ///< before what comes next
  int depth_ = 0;
};

const Quantity* quantity(const Dimension& dimension) {
  for (const Quantity& q : quantities)
    if (q.dimension == dimension) return &q;
  return nullptr;
}

}  // namespace

std::optional<Unit> unit(std::string_view text) {
  if (text.empty() || text.size() > longest) return std::nullopt;
  return UnitReader(text).whole();
}

double converted(double number, const Unit& from, const Unit& to) {
  // powers of ten cancel before anything is rounded
  const double above = from.numerator * to.denominator, below = from.denominator * to.numerator;
  if (above == below) return number;
  return above > below && std::fmod(above, below) == 0 ? number * (above / below)
         : std::fmod(below, above) == 0                ? number / (below / above)
                                                       : number * above / below;
}

std::string quantity_name(const Dimension& d) {
  if (const Quantity* known = quantity(d)) return std::string(known->name);
  std::string text = "a quantity in";
  for (const auto& [base, power] : {std::pair{"cm", d.length}, std::pair{"g", d.mass}, std::pair{"s", d.time},
                                    std::pair{"statC", d.charge}, std::pair{"rad", d.angle}})
    if (power != 0) text += power == 1 ? fmt::format(" {}", base) : fmt::format(" {}^{}", base, power);
  return text;
}

std::string_view usual_units(const Dimension& dimension) {
  const Quantity* known = quantity(dimension);
  return known ? known->usual : std::string_view();
}

}  // namespace treejet
