/// What a run by timestep measures of its own errors (core/observe/step_errors.hpp).

#include <catch2/catch.hpp>

#include <cmath>

#include "core/observe/step_errors.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// A bead of which all decays at one rate, seen over so many steps of a scheme that multiplies by `factor`.
struct Decay {
  double h;
  double factor;

  SolutionPoint<1> at(int step) const {
    SolutionPoint<1> point;
    point.t = h * step;
    point.y.resize(1, own_columns<1>);
    point.y << 1, 2, 3;
    point.y *= std::pow(factor, step);
    point.slope = point.y;
    point.slope *= -1;
    return point;
  }
};

/// A nozzle and a collector at which nothing happens.
Parameters still() {
  Parameters p = example("straight-jet");
  p.inserting = p.removing = false;
  return p;
}

double step_error(const Decay& decay) {
  const Run<1> run(still());
  StepErrors<1> errors(run.scene.nozzle, run.scene.collector, EventRule::located, 1);
  for (int step = 0; step < 40; ++step) {
    const SolutionPoint<1> from = decay.at(step), to = decay.at(step + 1);
    Jet<1> jet;
    static_cast<SolutionPoint<1>&>(jet) = from;
    errors.segment(jet, DenseOutput<1>(from, to));
  }
  CHECK(errors.samples() == 3);  // of steps 1 and 2, 17 and 18, 33 and 34
  return errors.step_error();
}

double of_change(double factor, double h) {
  return std::abs(factor * factor - std::exp(-2 * h)) / (1 - std::exp(-2 * h));
}

}  // namespace

TEST_CASE("The error of a fixed step is told as it is for Euler and Heun, in size for the fourth order") {
  const double h = GENERATE(0.02, 0.01);
  const double euler = 1 - h, heun = euler + h * h / 2, rk4 = heun - h * h * h / 6 + h * h * h * h / 24;
  // Simpson's rule errs by h^4 / 180, next to which theirs are h / 2 and h^2 / 6; the next term is h of it
  CHECK(step_error({h, euler}) == Approx(of_change(euler, h)).epsilon(2 * h));
  CHECK(step_error({h, heun}) == Approx(of_change(heun, h)).epsilon(2 * h));
  const double ratio = step_error({h, rk4}) / of_change(rk4, h);
  // h^5 / 60 of two steps beside the rule's h^5 / 90: of equal sign or not, 1 / 3 to 5 / 3, and 5 % for h
  CHECK(ratio > 0.95 / 3);
  CHECK(ratio < 1.05 * 5 / 3);
}

TEST_CASE("The error of a fixed step is not told over an event, a kink or two steps of different length") {
  const Run<1> run(still());
  StepErrors<1> errors(run.scene.nozzle, run.scene.collector, EventRule::located, 1);
  const Decay slow{0.01, 0.99}, fast{0.02, 0.98};
  const auto see = [&](const SolutionPoint<1>& from, const SolutionPoint<1>& to, double until) {
    Jet<1> jet;
    static_cast<SolutionPoint<1>&>(jet) = from;
    DenseOutput<1> segment(from, to);
    segment.until = until;
    errors.segment(jet, segment);
  };
  for (int k = 0; k < 64; ++k) {
    SolutionPoint<1> kinked = slow.at(1);
    kinked.slope *= 2;
    see(slow.at(0), slow.at(1), 0.01);
    if (k % 3 == 0) see(slow.at(1), slow.at(2), 0.015);  // an event within the step
    if (k % 3 == 1) see(kinked, slow.at(2), 0.02);
    if (k % 3 == 2) see(slow.at(1), fast.at(2), 0.04);
  }
  CHECK(errors.samples() == 0);
}

TEST_CASE("An event at the end of a step is late by what it is overdue over its speed") {
  // steps of 1, speed 1, events due every 2.5: late by 0, 1/2, 0, 1/2, ... : 1/4 in the mean, a tenth of 2.5
  Lateness lateness;
  for (int k = 1; k <= 40; ++k) {
    const double due = 2.5 * k;
    lateness.add(std::ceil(due), std::ceil(due) - due);
  }
  CHECK(lateness.relative() == Approx(0.1).epsilon(0.02));  // the first interval, of 40, is a long one
}
