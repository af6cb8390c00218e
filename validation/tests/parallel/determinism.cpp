/// The bits of a result do not depend on the number of threads.

#include <catch2/catch.hpp>

#include "core/observe/window.hpp"
#include "integrators/schemes/sra1.hpp"
#include "validation/support/run.hpp"

using namespace treejet;
using Catch::Matchers::WithinRel;

namespace {

/// A coil of 1500 beads with uneven velocities and stresses, enough for five threads.
Jet<3> coil(const Run<3>& run) {
  Jet<3> jet;
  for (int i = 1500; i >= 1; --i) {
    const double s = 0.6 * i, turn = 0.05 * i;
    const Vec<3> r(s, 3 * std::cos(turn) - 3, 2 * std::sin(turn));
    append<3>(jet, {r, Vec<3>(std::sin(s), std::cos(2 * s), std::sin(3 * s)), std::cos(s)});
  }
  jet.t = 0.3;
  jet.held = run.jet().held;
  return jet;
}

template <int D>
bool same_bits(const State<D>& a, const State<D>& b) {
  return a.rows() == b.rows() && (a == b).all();
}

/// Each number has a rate of its own, which goes with its value and the time.
class OwnRates final : public RightHandSide<3> {
 public:
  void operator()(const Jet<3>&, double t, const State<3>& y, State<3>& slope) override {
    slope = y.sin() - t * y;
  }
  /// Any Jacobian leaves a scheme that solves for it its order.
  void differentiate(const Jet<3>&, double, const State<3>& y, LocalJacobian<3>& J) override {
    ElementJacobian<3> spring;
    spring.tension_by_d = Eigen::Matrix3d::Identity();
    spring.stress.by_state = -Eigen::Matrix2d::Identity();
    J.element.assign(static_cast<std::size_t>(y.rows()), spring);
    J.inverse_mass = Eigen::ArrayXd::Ones(y.rows());
  }
};

/// By noise if it is the scheme for that.
std::unique_ptr<Stepper<3>> steps_of(Scheme scheme) {
  if (scheme == Scheme::sra1)
    return std::make_unique<Sra1<3>>(Noise{.diffusivity = 1}, wiener_path(/*seed*/ 7));
  return stepper<3>(scheme);
}

}  // namespace

TEST_CASE("The slopes of 1500 beads have the same bits on 1, 2, 3 and 4 threads") {
  State<3> one;
  for (int threads : {1, 2, 3, 4}) {
    Run<3> run(example("pvp"), {threads});
    const Jet<3> jet = coil(run);
    State<3> dy;
    (*run.scene.motion)(jet, jet.t, jet.y, dy);
    REQUIRE(dy.isFinite().all());
    if (threads == 1) one = dy;
    CHECK(same_bits<3>(dy, one));
  }
}

TEST_CASE("A cut off Coulomb sum has the same bits on any number of threads, too") {
  Parameters p = example("pvp");
  p.cutoff = 1;
  State<3> one;
  for (int threads : {1, 2, 3, 4}) {
    Run<3> run(p, {threads});
    const Jet<3> jet = coil(run);
    State<3> dy;
    (*run.scene.motion)(jet, jet.t, jet.y, dy);
    if (threads == 1) one = dy;
    CHECK(same_bits<3>(dy, one));
  }
}

TEST_CASE("A run with insertions and removals on several threads has the bits of one thread") {
  // a fine resolution, so that four threads' worth of beads are on the jet
  Parameters p = example("pvp");
  p.external_potential /= 16;
  p.collector_distance = 1;
  p.initial_length = 1;
  p.points = 1100;
  p.nozzle_cross = 5e-4;
  State<3> one;
  Effort effort;
  for (int threads : {1, 2, 3, 4}) {
    Run<3> run(with_steps(p, Scheme::heun, 1e-6), {threads});
    run.scene.jet.y.col(velocity_column<3>) =
        200 / run.unit.velocity;  // drawn out at full speed: 5 us a bead
    const Effort now = run.to(2e-5);
    REQUIRE(run.jet().size() >= 4 * beads_worth_a_thread);  // so that each number of threads is another one
    if (threads == 1) one = run.jet().y, effort = now;
    CHECK(now.placed == effort.placed);
    CHECK(now.removed == effort.removed);
    CHECK(same_bits<3>(run.jet().y, one));
  }
  CHECK(effort.removed > 0);
  CHECK(effort.released > 0);
}

TEST_CASE("Two runs of the same deck have the same bits") {
  State<3> first;
  for (int again : {0, 1}) {
    Run<3> run(with_tolerance(example("pvp"), 1e-6));
    run.to(2e-3);
    if (again == 0) first = run.jet().y;
    CHECK(same_bits<3>(run.jet().y, first));
  }
}

TEST_CASE("The state and the path length within a step have the same bits on 1, 2, 3 and 4 threads") {
  const Eigen::Index rows = rows_worth_sharing + 12'345;
  const double h = 0.01;
  // free flight with an acceleration of its own for each bead
  SolutionPoint<3> from{0.1, State<3>(rows), State<3>(rows)};
  for (Eigen::Index k = 0; k < from.y.size(); ++k)
    from.y(k) = std::sin(double(k + 1)), from.slope(k) = std::cos(double(k + 1));
  SolutionPoint<3> to = from;
  to.t += h;
  const auto [x, v] = std::pair{Eigen::seqN(0, 3), Eigen::seqN(velocity_column<3>, 3)};
  const auto all = Eigen::all;
  to.y(all, x) += h * from.y(all, v) + h * h / 2 * from.slope(all, v);
  to.y(all, v) += h * from.slope(all, v);
  const double before = path_length<3>(from.y, {0, 0, 0}), after = path_length<3>(to.y, {0, 0, 0});
  const Run<3> run(example("pvp"));
  double one = 0;
  const double third = from.t + h / 3;
  for (int threads : {1, 2, 3, 4}) {
    const DenseOutput<3> segment(from, to, rows_shared({threads}));
    CHECK(same_bits<3>(segment.at(third), DenseOutput<3>(from, to).at(third)));
    Statistics<3> statistics(run.scene.nozzle, run.scene.collector);
    statistics.follow_path();
    statistics.begin_window(from.t);
    statistics.integrate(segment, to.t);
    const double length = statistics.window().path_length;
    if (threads == 1) one = length;
    CHECK(length == one);
    // the mean of the ends errs by h^2 / 12 times the second derivative of the length, which is as the length
    CHECK_THAT(length, WithinRel((before + after) / 2 * h, h * h));
  }
}

TEST_CASE("A step of a long table has the same bits on 1, 2, 3 and 4 threads, with every scheme") {
  const Eigen::Index rows = rows_worth_sharing + 12'345;
  SolutionPoint<3> from{0.1, State<3>(rows), State<3>(rows)};
  for (Eigen::Index k = 0; k < from.y.size(); ++k) from.y(k) = std::sin(double(k + 1));
  OwnRates f;
  Jet<3> jet;
  f(jet, from.t, from.y, from.slope);
  jet.y = from.y;
  jet.mass = Eigen::ArrayXd::Ones(rows);
  for (const Scheme scheme : {Scheme::euler, Scheme::heun, Scheme::rk4, Scheme::sra1, Scheme::dopri5,
                              Scheme::verner6, Scheme::kencarp5}) {
    INFO(name(scheme));
    State<3> one, error;
    for (int threads : {1, 2, 3, 4}) {
      const auto steps = steps_of(scheme);
      steps->rows_shared = rows_shared({threads});
      // memory that is given out once more may hold the numbers of the turn before
      State<3> next = State<3>::Constant(rows, from.y.cols(), std::nan(""));
      steps->step(f, jet, from, 0.01, next);
      if (threads == 1) one = next, error = steps->error;
      CHECK(same_bits<3>(next, one));
      CHECK(same_bits<3>(steps->error, error));
    }
    REQUIRE(one.rows() == rows);
    CHECK((one - from.y).abs().minCoeff() > 0);  // no row has been left out
  }
}
