/// Orders of convergence on a smooth problem: the paper's single bead, straight and with a transverse motion.

#include <catch2/catch.hpp>
#include <map>

#include "validation/support/run.hpp"

using namespace treejet;

namespace {

constexpr double t_end = 0.01;  // s: scaled time 1

/// The single bead in three dimensions, with gravity and a push to the side.
Run<3> pushed_aside(const Parameters& p) {
  Parameters q = p;
  q.system = 3;
  q.gravity = true;
  Run<3> run(q);
  run.scene.jet.y.row(0).segment<3>(3) << 0, 0.8, -0.3;
  return run;
}

/// Largest error of the state at t_end by each of the steps.
template <class MakeRun>
std::vector<double> errors(MakeRun make, Scheme scheme, const std::vector<double>& scaled_steps) {
  const Parameters p = example("single-bead");
  auto reference = make(with_steps(p, Scheme::verner6, t_end / 1000));  // its error is below round-off
  reference.to(t_end);
  std::vector<double> e;
  for (double h : scaled_steps) {
    auto run = make(with_steps(p, scheme, h * reference.unit.time));
    run.to(t_end);
    e.push_back((run.jet().y - reference.jet().y).abs().maxCoeff());
  }
  return e;
}

const std::map<Scheme, std::vector<double>> steps{
    // small enough for the next term of the error to change the order by less than 0.3 (dopri5: 20 h of the
    // first
    // term, 0.2 at the last halving), large enough to stay three digits above round-off
    {Scheme::euler, {1. / 400, 1. / 800, 1. / 1600}}, {Scheme::heun, {1. / 100, 1. / 200, 1. / 400}},
    {Scheme::rk4, {1. / 50, 1. / 100, 1. / 200}},     {Scheme::dopri5, {1. / 40, 1. / 80, 1. / 160}},
    {Scheme::verner6, {1. / 20, 1. / 40, 1. / 80}},   {Scheme::kencarp5, {1. / 40, 1. / 80, 1. / 160}}};

int nominal(Scheme scheme) {
  return stepper<1>(scheme)->order();
}

}  // namespace

TEST_CASE("The schemes have the orders 1, 2, 4, 5, 6 and 5 that they are known by") {
  CHECK(nominal(Scheme::euler) == 1);
  CHECK(nominal(Scheme::heun) == 2);
  CHECK(nominal(Scheme::rk4) == 4);
  CHECK(nominal(Scheme::dopri5) == 5);
  CHECK(nominal(Scheme::verner6) == 6);
  CHECK(nominal(Scheme::kencarp5) == 5);
}

TEST_CASE("What the table of schemes says of a scheme is what its stepper does") {
  for (const auto& row : schemes) {
    CAPTURE(row.word);
    CHECK(steps.contains(row.scheme) == (row.scheme != Scheme::automatic));  // all orders are measured below
    if (row.scheme == Scheme::automatic) continue;
    Run<3> run = pushed_aside(example("single-bead"));
    SolutionPoint<3> from{0, run.jet().y, {}};
    (*run.scene.motion)(run.jet(), 0, from.y, from.slope);
    const auto scheme = stepper<3>(row.scheme);
    State<3> next;
    scheme->step(*run.scene.motion, run.jet(), from, 0.01, next);
    CHECK(scheme->order() == row.order);
    CHECK((scheme->error.rows() > 0) == row.adaptive);
  }
}

TEST_CASE("The control of a pair takes the estimate for what it is, of the order of the pair") {
  for (const auto& row : schemes) {
    if (!row.adaptive || row.scheme == Scheme::automatic) continue;
    CAPTURE(row.word);
    const auto control = step_control(with_tolerance(example("pvp"), 1e-6, row.scheme));
    const double h = control->proposal(0, 1);
    // an error of 2^order times the share would be one at half the step, but for the safety factor 0.9
    REQUIRE(!control->accepts(0, h, row.share * std::pow(2, row.order)));
    CHECK(control->proposal(0, 1) == Approx(0.9 * h / 2).epsilon(1e-14));
  }
}

TEST_CASE("Each scheme shows its order on the straight bead of paper case 1") {
  for (const auto& [scheme, h] : steps) {
    const auto e = errors([](const Parameters& p) { return Run<1>(p); }, scheme, h);
    CAPTURE(name(scheme), e);
    CHECK(orders(e).back() == Approx(nominal(scheme)).margin(0.3));
  }
}

TEST_CASE("Each scheme shows its order on a bead that moves in three dimensions") {
  for (const auto& [scheme, h] : steps) {
    const auto e = errors(pushed_aside, scheme, h);
    CAPTURE(name(scheme), e);
    CHECK(orders(e).back() == Approx(nominal(scheme)).margin(0.3));
  }
}

TEST_CASE("The error estimate of a pair is of the order of its lower partner, one step's error") {
  for (Scheme scheme : {Scheme::dopri5, Scheme::verner6, Scheme::kencarp5}) {
    Run<3> run = pushed_aside(example("single-bead"));
    SolutionPoint<3> from{0, run.jet().y, {}};
    (*run.scene.motion)(run.jet(), 0, from.y, from.slope);
    const auto pair = stepper<3>(scheme);
    std::vector<double> estimate;
    State<3> next;
    for (double h : {0.04, 0.02, 0.01}) {
      pair->step(*run.scene.motion, run.jet(), from, h, next);
      estimate.push_back(pair->error.abs().maxCoeff());
    }
    // partner of order p - 1: local error of order p
    CAPTURE(name(scheme), estimate);
    CHECK(orders(estimate).back() == Approx(nominal(scheme)).margin(0.3));
  }
}

TEST_CASE("An explicit pair ends with the slope of its result, which is the first of the next step") {
  for (Scheme scheme : {Scheme::dopri5, Scheme::verner6}) {
    Run<3> run = pushed_aside(example("single-bead"));
    SolutionPoint<3> from{0, run.jet().y, {}};
    (*run.scene.motion)(run.jet(), 0, from.y, from.slope);
    const auto pair = stepper<3>(scheme);
    State<3> next, slope;
    pair->step(*run.scene.motion, run.jet(), from, 0.05, next);
    (*run.scene.motion)(run.jet(), 0.05, next, slope);
    CAPTURE(name(scheme));
    CHECK((*pair->slope_at_end() == slope).all());
  }
}

TEST_CASE("The error estimate is about as large as the error of the lower partner") {
  for (Scheme scheme : {Scheme::dopri5, Scheme::verner6, Scheme::kencarp5}) {
    const double h = 0.05;
    const Parameters p = example("single-bead");
    Run<3> exact = pushed_aside(with_steps(p, Scheme::verner6, t_end / 1000));
    Run<3> run = pushed_aside(p);
    exact.to(h * run.unit.time);
    SolutionPoint<3> from{0, run.jet().y, {}};
    (*run.scene.motion)(run.jet(), 0, from.y, from.slope);
    const auto pair = stepper<3>(scheme);
    State<3> next;
    pair->step(*run.scene.motion, run.jet(), from, h, next);
    const double error = (next - exact.jet().y).abs().maxCoeff();
    const double partner_error = (next - pair->error - exact.jet().y).abs().maxCoeff();
    CAPTURE(name(scheme), error, partner_error);
    CHECK(error < partner_error);  // else one would better go on with the partner
    CHECK(pair->error.abs().maxCoeff() == Approx(partner_error).epsilon(0.5));
  }
}
