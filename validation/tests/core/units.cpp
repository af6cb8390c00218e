#include "core/deck/units.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "core/deck/directives.hpp"

using namespace treejet;

namespace {

double in(const std::string& from, const std::string& to) {
  const auto a = unit(from), b = unit(to);
  REQUIRE((a && b));
  REQUIRE(a->dimension == b->dimension);
  return converted(1, *a, *b);
}

}  // namespace

TEST_CASE("Powers of ten between units are exact", "[units]") {
  CHECK(in("Pa s", "g/(cm s)") == 10);
  CHECK(in("mPa s", "P") == 0.01);
  CHECK(in("Pa", "g/(cm s^2)") == 10);
  CHECK(in("MPa", "dyn/cm2") == 1e7);
  CHECK(in("kg/m3", "g/cm^3") == 1e-3);
  CHECK(in("mN/m", "g/s^2") == 1);
  CHECK(in("um", "cm") == 1e-4);
  CHECK(in("\u00b5m", "\u03bcm") == 1);
  CHECK(in("mL", "cm^3") == 1);
  CHECK(in("J", "erg") == 1e7);
  CHECK(in("V", "J/C") == 1);
  CHECK(in("mC/L", "C/m3") == 1);
  CHECK(in("kV/cm", "V/m") == 1e5);
  CHECK(in("h", "min") == 60);
}

TEST_CASE("Electrostatic units follow from the speed of light, without rounding of theirs", "[units]") {
  CHECK(in("C", "statC") == 2997924580.);
  CHECK(in("C/L", "statC/cm^3") == 2997924.58);
  CHECK(in("A", "statC/s") == 2997924580.);
  CHECK(in("statV", "V") == 299.792458);
  CHECK(in("statV", "erg/statC") == 1);
  CHECK(std::abs(in("kV", "statV") * 0.299792458 - 1) < 4e-16);  // two roundings
}

TEST_CASE("A cycle is an angle: hertz and radians a second differ by 2 pi, and a bare rate is neither",
          "[units]") {
  CHECK(in("Hz", "rad/s") == 2 * std::numbers::pi);
  CHECK(unit("1/s")->dimension != unit("Hz")->dimension);
}

TEST_CASE("A unit may be spelled as product, quotient and power in several ways", "[units]") {
  for (const char* spelling : {"g/(cm s)", "g/cm/s", "g cm-1 s-1", "g*cm^-1*s^-1", "g/(cm*s)",
                               "g\u00b7cm-1\u00b7s-1", "dyn s/cm2", "dyn*s/cm\u00b2", "P", "poise"}) {
    INFO(spelling);
    CHECK(in(spelling, "g/(cm s)") == 1);
  }
}

TEST_CASE("What is no unit, or could be two, is not taken for one", "[units]") {
  for (const char* text :
       {"",     " ",     "g/cm s", "xyz",           "kV/", "/s",   "(g", "g)",        "cm^",
        "cm^0", "cm^99", "cm^x",   "V V V)",        "kk",  "mmin", "kh", "((((g))))", "PA",
        "kv",   "5",     "m s2 3", "cm^99999999999"}) {
    INFO(text);
    CHECK(!unit(text));
  }
  CHECK(!unit(std::string(1000, '(')));
}

TEST_CASE("The case of a letter counts: milli is not mega, minutes are not metres", "[units]") {
  CHECK(in("MPa", "mPa") == 1e9);
  CHECK(in("min", "s") == 60);
  CHECK(unit("m")->dimension != unit("min")->dimension);
}

TEST_CASE("Every unit of the table of directives is one, and has a name and units of the laboratory",
          "[units]") {
  for (const Directive& d : directives())
    for (const std::string_view text : {d.unit, d.real_unit}) {
      if (text.empty()) continue;
      INFO(text);
      REQUIRE(unit(text));
      CHECK(!usual_units(unit(text)->dimension).empty());
      CHECK(quantity_name(unit(text)->dimension).find("a quantity in") == std::string::npos);
      if (!d.real_unit.empty()) CHECK(unit(d.real_unit)->dimension == unit(d.unit)->dimension);
    }
}

TEST_CASE("The units named as usual are units of that quantity", "[units]") {
  for (const char* text : {"cm", "s", "cm/s", "g/cm3", "statC/cm3", "g/(cm s)", "Pa", "g/s2", "statV",
                           "rad/s", "cm3/s", "statC/s", "kV/cm", "m/s2"}) {
    const Dimension dimension = unit(text)->dimension;
    std::string_view rest = usual_units(dimension);
    REQUIRE(!rest.empty());
    while (!rest.empty()) {
      const std::string_view one = rest.substr(0, rest.find(", "));
      INFO(one);
      REQUIRE(unit(one));
      CHECK(unit(one)->dimension == dimension);
      rest.remove_prefix(std::min(rest.size(), one.size() + 2));
    }
  }
}
