/// States that a run does not go on with, one each.

#include "integrators/march/diagnosis.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "integrators/run/integration.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;
using Catch::Matchers::Contains;

namespace {

constexpr double l_step = 1;

State<3> positions(const std::vector<Vec<3>>& r) {
  State<3> y(static_cast<Eigen::Index>(r.size()), own_columns<3>);
  y.setZero();
  for (std::size_t i = 0; i < r.size(); ++i)
    y.row(static_cast<Eigen::Index>(i)).head<3>() = r[i].transpose().array();
  return y;
}

State<1> positions(const std::vector<double>& x) {
  State<1> y(static_cast<Eigen::Index>(x.size()), own_columns<1>);
  y.setZero();
  for (std::size_t i = 0; i < x.size(); ++i) y(static_cast<Eigen::Index>(i), 0) = x[i];
  return y;
}

}  // namespace

TEST_CASE("A straight jet is in order from the collector to the nozzle, and in front of it") {
  const State<1> before = positions({3., 2., 1.});
  CHECK(!state_check<1>(before, positions({3.1, 2.1, 1e-9}), l_step, 0));
  CHECK_THAT(state_check<1>(before, positions({3., 1., 2.}), l_step, 0).value(), Contains("crossed"));
  CHECK_THAT(state_check<1>(before, positions({3., 2., -1e-9}), l_step, 0).value(),
             Contains("bead 2 has moved back behind the nozzle"));
}

TEST_CASE("An element may turn by less than a right angle in a step, or its beads have swapped") {
  const State<3> before = positions({{2, 0, 0}, {1, 0, 0}});
  CHECK(!state_check<3>(before, positions({{1.1, 5, 0}, {1, 0, 0}}), l_step, 0));
  CHECK_THAT(state_check<3>(before, positions({{0.9, 5, 0}, {1, 0, 0}}), l_step, 0).value(),
             Contains("beads 0 and 1 have swapped sides"));
}

TEST_CASE("The youngest bead may swing behind the nozzle by an element, not be thrown farther") {
  const State<3> before = positions({{2, 0, 0}, {0.5, 0, 0}});
  CHECK(!state_check<3>(before, positions({{2, 0, 0}, {-0.9, 0, 0}}), l_step, 0));
  CHECK_THAT(state_check<3>(before, positions({{2, 0, 0}, {-1.1, 0, 0}}), l_step, 0).value(),
             Contains("bead 1 has been thrown behind the nozzle"));
}

TEST_CASE("Whoever looks at which rows of a long jet, the oldest bead that is wrong is named") {
  const Eigen::Index n = rows_worth_sharing + 5000;
  State<3> before(n);
  before.setZero();
  before.col(0) = Eigen::ArrayXd::LinSpaced(n, double(n), 1);
  for (int threads : {1, 2, 3, 4}) {
    const RowSharing shared = rows_shared({threads});
    State<3> y = before;
    CHECK(!state_check<3>(before, y, l_step, 0, shared));
    for (const Eigen::Index swapped : {n - 2, Eigen::Index{12'287}, Eigen::Index{7}}) {  // 12288 is a border
      y(swapped, 0) = y(swapped + 1, 0) - 0.5;
      CHECK_THAT(state_check<3>(before, y, l_step, 0, shared).value(),
                 Contains(fmt::format("beads {} and {} have swapped", swapped, swapped + 1)));
    }
    for (const Eigen::Index lost : {n - 1, Eigen::Index{9000}}) {
      y(lost, stress_column<3>) = std::numeric_limits<double>::quiet_NaN();
      CHECK_THAT(state_check<3>(before, y, l_step, 0, shared).value(),
                 Contains(fmt::format("bead {} ", lost)) && Contains("no longer finite"));
    }
  }
}

TEST_CASE("A bead that the nozzle lets go half an element too late stops the run") {
  Parameters p = plain_parameters();
  p.inserting = true;
  const Nozzle<1> nozzle(p);
  CHECK_NOTHROW(nozzle.check_timely(jet_of<1>({bead_at(1.9)})));  // due at 1.5
  CHECK_THROWS_AS(nozzle.check_timely(jet_of<1>({bead_at(2.1)})), NumericalError);
}
