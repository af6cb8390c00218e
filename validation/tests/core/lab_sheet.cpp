#include "core/deck/lab_sheet.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/deck/deck.hpp"

using namespace treejet;

namespace {

Parameters case_3(const std::vector<std::string>& overrides = {}) {
  return read_deck(std::string(TREEJET_SOURCE_DIR) + "/examples/pvp/input.dat", overrides).parameters;
}

SheetRow row(const std::vector<SheetRow>& sheet, const std::string& key) {
  const auto found =
      std::find_if(sheet.begin(), sheet.end(), [&](const SheetRow& r) { return r.key == key; });
  INFO(key);
  REQUIRE(found != sheet.end());
  return *found;
}

constexpr double pi = std::numbers::pi;
constexpr double round_off = 1e-14;  // a dozen products and quotients

void check_value(double value, double expected) {
  CHECK(std::abs(value / expected - 1) < round_off);
}

}  // namespace

TEST_CASE("The laboratory sheet of the PVP jet has the values of a hand calculation", "[lab sheet]") {
  const std::vector<SheetRow> sheet = lab_sheet(case_3(
      {"external potential 9 kV", "collector distance 15", "density charge 30000", "nozzle velocity 0.25"}));
  check_value(row(sheet, "field").value, 0.6);                               // 9 kV on 15 cm
  check_value(row(sheet, "flow_supplied").value, pi * 25e-6 * 0.25 * 3600);  // 1 cm^3/s is 3600 mL/h
  check_value(row(sheet, "current_supplied").value, 30000 * pi * 25e-6 * 0.25 / 2.99792458);
  check_value(row(sheet, "relaxation_time").value, 0.4);  // 20 / 50000 s
  check_value(row(sheet, "nozzle_radius").value, 50);
  check_value(row(sheet, "element").value, 200);
  check_value(row(sheet, "deborah").value, 4e-4 * 0.25 / 5e-3);
  check_value(row(sheet, "surface_field").value, 2 * pi * 30000 * 5e-3 * 0.299792458);
  check_value(row(sheet, "corona_onset").value, 30 * (1 + 0.301 / std::sqrt(5e-3)));
  check_value(row(sheet, "electrostatic").value, std::pow(30000 * pi * 25e-6, 2) / (pi * 25e-6 * 5e4));
}

TEST_CASE("The published PVP deck is charged beyond the corona's onset, a hundredth of its charge is not",
          "[lab sheet]") {
  // 41 MV/m against 16 MV/m
  const std::vector<SheetRow> sheet = lab_sheet(case_3());
  CHECK(row(sheet, "surface_field").value == Approx(414).epsilon(0.005));  // both given with three digits
  CHECK(row(sheet, "corona_onset").value == Approx(158).epsilon(0.005));
  CHECK(row(sheet, "bending").value == Approx(36).epsilon(0.02));
  CHECK(!row(sheet, "surface_field").warning.empty());
  CHECK(row(lab_sheet(case_3({"density charge 440"})), "surface_field").warning.empty());
}

TEST_CASE("A jet faster than sound and a draw of a thousand times the supply are pointed out",
          "[lab sheet]") {
  const Parameters p = case_3();
  const double supply = pi * p.nozzle_cross * p.nozzle_cross * p.nozzle_velocity;
  const std::vector<SheetRow> absurd = lab_sheet(p, Draw{1001 * supply, 34301});
  CHECK(!row(absurd, "flow_drawn").warning.empty());
  CHECK(!row(absurd, "front_speed").warning.empty());
  CHECK(lab_sheet_text(absurd).find("faster than sound") != std::string::npos);
  const std::vector<SheetRow> sane = lab_sheet(p, Draw{999 * supply, 34299});
  CHECK(row(sane, "flow_drawn").warning.empty());
  CHECK(row(sane, "front_speed").warning.empty());
  // flow = pi a^2 v: a jet of the supply's flow and the nozzle's speed has the nozzle's radius
  check_value(row(lab_sheet(p, Draw{supply, p.nozzle_velocity}), "front_radius").value, 50);
}

TEST_CASE("The sheet of a deck in real units is that of the same deck in CGS", "[lab sheet]") {
  const auto cgs =
      lab_sheet(case_3({"density charge 44069.491326", "external potential 30.020768567833684"}));
  const auto real = lab_sheet(case_3({"units real", "density charge 0.0147", "external potential 9000"}));
  REQUIRE(cgs.size() == real.size());
  for (std::size_t i = 0; i < cgs.size(); ++i) CHECK(real[i].value == Approx(cgs[i].value).epsilon(1e-12));
}
