/// The force error that a run measures of itself: ferr and ferrmax in its tables.

#include <catch2/catch.hpp>

#include "core/observe/accuracy_warning.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// A straight jet of 600 beads that starts to move.
Parameters long_jet(CoulombSum coulomb, double accuracy) {
  Parameters p = example("pvp");
  p.initial_length = 3;
  p.points = 600;
  p.coulomb = coulomb;
  p.coulomb_accuracy = accuracy;
  return p;
}

std::vector<std::vector<double>> errors(Run<3>& run) {
  return recorded<3>(run, {"ferr", "ferrmax"}, 2e-6, 6e-6);
}

}  // namespace

TEST_CASE("A run with a direct sum reports no force error") {
  Run<3> run(long_jet(CoulombSum::direct, 1e-3));
  CHECK(run.scene.force_error() == nullptr);
  for (const auto& row : errors(run)) CHECK(row == std::vector<double>{0, 0});
}

TEST_CASE("A run with a tree reports the force error it has measured, below the accuracy asked for") {
  Run<3> run(long_jet(CoulombSum::tree, 1e-4));
  const FieldErrorReport& error = *run.scene.force_error();
  const auto rows = errors(run);
  REQUIRE(rows.size() == 4);
  for (std::size_t k = 1; k < rows.size(); ++k) {  // nothing is evaluated before the first row
    CHECK(rows[k][0] > 0);
    CHECK(rows[k][0] <= 1e-4);
    CHECK(rows[k][1] >= rows[k][0]);
  }
  CHECK(error.missed == 0);
  CHECK(error.worst_l2 >= rows.back()[0]);
  CHECK(summary_of(error).find("MISSED") == std::string::npos);
}

TEST_CASE("A run that misses its accuracy says so") {
  Parameters p = long_jet(CoulombSum::tree, 1e-8);
  p.coulomb_order = 3;
  p.coulomb_opening = 0.6;
  Run<3> run(p);
  const FieldErrorReport& error = *run.scene.force_error();
  const auto rows = errors(run);
  CHECK(rows.back()[0] > 1e-8);
  CHECK(error.missed == error.samples);
  CHECK(summary_of(error).find("MISSED") != std::string::npos);
}
