/// When the error of the field is measured, and what follows from it: worked out by hand.

#include <catch2/catch.hpp>
#include <cmath>

#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "forces/coulomb/solver/rebuild_policy.hpp"
#include "validation/support/point_sets.hpp"

using namespace treejet;

TEST_CASE(
    "The error is measured anew where the points have changed by a twentieth, or a share of the work asks") {
  RebuildPolicy policy({});
  policy.chosen(1000, 1000);
  const double work = 100, pairs = 300;  // a measurement costs 400, four hundredths of 100 evaluations
  for (int k = 1; k < 100; ++k) REQUIRE_FALSE(policy.at_evaluation(1000, work, pairs).measurement);
  CHECK(policy.at_evaluation(1000, work, pairs).measurement);
  policy.measured(1000, 1000);
  CHECK_FALSE(policy.at_evaluation(1050, work, pairs).measurement);
  CHECK(policy.at_evaluation(1051, work, pairs).measurement);
  CHECK(policy.at_evaluation(949, work, pairs).measurement);
  CHECK(policy.at_evaluation(1000, work, pairs, /*otherwise_due*/ true).measurement);
}

TEST_CASE("A piece that has been cut anew by more than a tenth is measured, but for a few points") {
  RebuildPolicy policy({});
  policy.chosen(1000, 100);
  CHECK_FALSE(policy.recut(110));
  CHECK(policy.recut(111));
  CHECK(policy.recut(89));
  policy.measured(1000, 10);
  CHECK_FALSE(policy.recut(14));
  CHECK(policy.recut(15));
}

TEST_CASE("Of points that move the opening is narrowed before the error is missed") {
  // an error that grows as the eighth power of the opening, a tenth below the accuracy at 0.5
  CoulombReport report;
  report.shape.opening = 0.5;
  double opening = 0.5;
  const auto measure = [&] {
    const double error = 1e-5 * std::pow(opening / 0.5, 8);
    return SampledError{error, error, error};
  };
  const auto reshape = [&](const TreeShape& to) { opening = to.opening; };
  CoulombRequest request{.accuracy = 1.1e-5};
  CHECK(keeps_accuracy(report, request, measure, reshape));
  CHECK(report.shape.opening == 0.5);
  request.points_move = true;  // one step wider it would err by 1.8e-5
  CHECK(keeps_accuracy(report, request, measure, reshape));
  CHECK(report.shape.opening == Approx(0.5 * narrowing).epsilon(1e-14));
  CHECK(opening == report.shape.opening);
}

TEST_CASE("A near field in single precision is given up where rounding errs, and only there") {
  // what rounding makes of two close points, and what the opening of 0.5 leaves out
  struct Part {
    double rounding, expansions;
    bool single_in_the_end;
  };
  for (const Part& part : {Part{3e-5, 0.5e-5, false}, Part{0, 0.5e-5, true}, Part{0.1e-5, 2e-5, true}}) {
    CoulombReport report;
    report.shape.opening = 0.5;
    report.shape.single = true;
    TreeShape now = report.shape;
    const auto measure = [&] {
      const double error =
          part.expansions * std::pow(now.opening / 0.5, 8) + (now.single ? part.rounding : 0);
      return SampledError{error, error, error};
    };
    const auto reshape = [&](const TreeShape& to) { now = to; };
    CHECK(keeps_accuracy(report, {.accuracy = 1e-5}, measure, reshape));
    CHECK(report.shape.single == part.single_in_the_end);
    CHECK(now.single == report.shape.single);
    CHECK(now.opening == report.shape.opening);
    CHECK((report.shape.opening == 0.5) == (part.expansions < 1e-5));
  }
}

TEST_CASE("The error that is expected has a quarter of allowance, and twice the spread between leaves") {
  CoulombSolver solver({.method = CoulombMethod::tree, .accuracy = 1e-4});
  const PointSet set = whipping_jet(6000);
  FieldSet field(set.size());
  solver.field(set.view(), {0, set.size()}, field.view(), {1});
  const CoulombReport& report = solver.report();
  REQUIRE_FALSE(report.direct);
  CHECK(report.expected_error <= 1e-4);
  // leaves of a jet that widens do not err alike: of 32 of them the spread of the mean is a tenth or more
  CHECK(report.expected_error > 1.25 * std::sqrt(1.1) * report.error.l2);
}

TEST_CASE("Two points that nearly meet do not hide the errors of all others") {
  const auto measured = [](const PointSet& set) {
    CoulombSolver solver({.method = CoulombMethod::tree, .order = 4, .opening = 0.6});
    FieldSet field(set.size());
    solver.field(set.view(), {0, set.size()}, field.view(), {1});
    return solver.report().error.l2;
  };
  PointSet set = whipping_jet(4000);
  const double alone = measured(set);
  for (std::size_t e = 0; e < 3; ++e) set.r[e][2000] = set.r[e][2001] + (e == 0 ? 1e-7 : 0);
  // their field is a million times the others'; it is in no mean, and in the sample only of their own leaf
  CHECK(measured(set) > alone / 2);
}

TEST_CASE("A leaf of one point has a near field in single precision, too") {
  const PointSet set = straight_line(33);
  TreeField tree;
  tree.arrange(set.view(), {.order = 6, .opening = 0.4, .leaf = 32, .single = true}, {1});
  FieldSet field(33), exact(33);
  tree.evaluate(tree.leaves_of({0, 33}), {0, 33}, field.view(), {1});
  coulomb_direct<3>(set.view(), {0, 33}, exact.view());
  // rounded places are 1e-7 of the distance to the farthest source apart, neighbours 1/32 of it
  for (std::size_t e = 0; e < 3; ++e) CHECK(field.e[e][32] == Approx(exact.e[e][32]).epsilon(1e-4));
}

TEST_CASE("A shape chosen for points that move is measured once more, for the room that it leaves them") {
  const PointSet set = coil(4000, 50, 0.02);
  FieldSet field(set.size());
  const auto samples = [&](bool points_move) {
    CoulombSolver solver({.method = CoulombMethod::tree, .accuracy = 1e-4, .points_move = points_move});
    solver.field(set.view(), {0, set.size()}, field.view(), {1});
    return solver.report().error.samples;
  };
  CHECK(samples(false) == 1);
  CHECK(samples(true) > 1);
}
