/// The norm of the step control, worked out by hand for errors of one number.

#include "core/jet/error_norm.hpp"

#include <catch2/catch.hpp>

#include "core/jet/stiffness.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

constexpr double tolerance = 1e-6, permitted = 25 * tolerance;
constexpr double round_off = 1e-14;  // of a handful of products

/// One bead at (3, 4, 0) with speed 2 along y and stress -5, and a column of value 0.25.
State<3> bead() {
  State<3> y(1, own_columns<3> + 1);
  y.row(0) << 3, 4, 0, 0, 2, 0, -5, 0.25;
  return y;
}

/// Of an error of 1e-6 in one column.
double norm_of(const ErrorNorm& norm, int column) {
  State<3> e(1, own_columns<3> + 1);
  e.setZero();
  e(0, column) = -1e-6;
  return norm.operator()<3>(e, bead());
}

}  // namespace

TEST_CASE("An error counts against the element, speed and modulus of the scene and the bead's own values") {
  Parameters p = plain_parameters();  // element, modulus and relaxation time are 1
  p.tolerance = tolerance;
  p.nozzle_velocity = 10;  // beads follow each other sooner than stress relaxes
  REQUIRE(stiffness(p).bead_interval < stiffness(p).relaxation);
  const ErrorNorm norm(p, {Column{.name = "solvent", .unit = "1", .small = 0.5}});
  for (int column : {0, 1, 2}) CHECK(norm_of(norm, column) == Approx(1e-6 / permitted).epsilon(round_off));
  for (int column : {3, 4, 5})
    CHECK(norm_of(norm, column) == Approx(1e-6 / (1 + 2) / permitted).epsilon(round_off));
  CHECK(norm_of(norm, 6) == Approx(1e-6 / (1 + 5) / permitted).epsilon(round_off));
  CHECK(norm_of(norm, 7) == Approx(1e-6 / (0.5 + 0.25) / permitted).epsilon(round_off));
}

TEST_CASE("Where stress relaxes between beads, speed and stress count by the time from bead to bead") {
  Parameters p = plain_parameters();
  p.tolerance = tolerance;
  p.nozzle_velocity = 0.02;
  p.final_time = 1000;
  const double T = stiffness(p).bead_interval / stiffness(p).relaxation;
  REQUIRE(T > 5);
  const ErrorNorm norm(p, {Column{.name = "solvent", .unit = "1"}});
  CHECK(norm_of(norm, 0) == Approx(1e-6 / permitted).epsilon(round_off));
  CHECK(norm_of(norm, 4) == Approx(1e-6 / (1 / T + 2) / permitted).epsilon(round_off));
  CHECK(norm_of(norm, 6) == Approx(1e-6 / (1 / T + 5) / permitted).epsilon(round_off));
}

TEST_CASE("A large tolerance permits no more than a tenth, and an error that is no number is none at all") {
  Parameters p = plain_parameters();
  p.tolerance = 0.5;
  p.nozzle_velocity = 10;
  const ErrorNorm norm(p, {Column{.name = "solvent", .unit = "1"}});
  CHECK(norm_of(norm, 0) == Approx(1e-6 / 0.1).epsilon(round_off));
  State<3> e = bead();
  e(0, 5) = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(norm.operator()<3>(e, bead())));
}
