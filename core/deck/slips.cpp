#include "core/deck/slips.hpp"

#include <fmt/format.h>

#include <cmath>

namespace treejet {

namespace {

struct Range {
  std::string_view words;
  std::string_view unit;  ///< in which the bare number is taken
  double least, most;     ///< zero is never a slip
  std::string_view below, above, unit_below, unit_above;
};

// clang-format off
constexpr Range ranges[] = {
    {"density mass", "g/cm^3", 0.05, 25, "lighter than any liquid", "denser than osmium", "kg/L", "kg/m3"},
    {"density charge", "statC/cm^3", 100, 1e7, "little for a jet (1 C/m3 is 2998 statC/cm^3)", "more than a jet can hold",
     "C/m3", "statC/cm^3"},
    {"density charge", "C/L", 1e-5, 1, "little for a jet", "a thousand times what a jet holds", "C/L", "C/m3"},
    {"external potential", "statV", 0.3, 400, "less than 100 V", "more than 120 kV (1 statV is 300 V)", "kV", "V"},
    {"external potential", "V", 100, 120e3, "less than 100 V", "more than 120 kV", "kV", "V"},
    {"collector distance", "cm", 0.5, 200, "a few millimetres", "more than two metres", "m", "mm"},
    {"nozzle cross", "cm", 1e-5, 0.15, "less than 0.1 um", "wider than 3 mm across: the radius is wanted", "m", "mm"},
    {"nozzle velocity", "cm/s", 1e-5, 1e3, "less than 0.1 um/s", "more than 10 m/s", "m/s", "mm/s"},
    {"flow rate", "cm^3/s", 1e-8, 0.1, "less than 36 nL/h", "more than 360 mL/h", "mL/s", "mL/h"},
    {"viscosity", "g/(cm s)", 2e-3, 1e5, "thinner than any solvent", "stiffer than pitch at work", "Pa s", "mPa s"},
    {"elastic modulus", "g/(cm s^2)", 0.1, 1e9, "hardly elastic", "stiffer than rubber", "kPa", "Pa"},
    {"surface tension", "g/s^2", 1, 600, "less than any liquid's", "more than mercury's", "N/m", "uN/m"},
    {"final time", "s", 1e-7, 100, "less than 0.1 us", "longer than a jet is followed", "s", "ms"},
};
// clang-format on

}  // namespace

std::string likely_slip(const Directive& d, double number, Units units) {
  const std::string_view unit = bare_unit(d, units);
  for (const Range& r : ranges) {
    if (r.words != d.words || r.unit != unit || number == 0) continue;
    if (std::abs(number) >= r.least && std::abs(number) <= r.most) return {};
    const bool low = std::abs(number) < r.least;
    const std::string_view meant = low ? r.unit_below : r.unit_above;
    const std::string hint =
        meant == unit ? "" : fmt::format("; if {0} are meant, write {1:.10g} {0}", meant, number);
    return fmt::format("taken as {:.10g} {}, {}{}", number, unit, low ? r.below : r.above, hint);
  }
  return {};
}

}  // namespace treejet
