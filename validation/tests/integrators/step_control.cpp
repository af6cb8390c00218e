/// How long steps are: what is learnt from one event to the next of its kind.

#include <catch2/catch.hpp>
#include <cmath>

#include "integrators/march/rhythm.hpp"
#include "integrators/march/step_control.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

TEST_CASE("Regular intervals foretell the next insertion, by their straight continuation") {
  Rhythm rhythm;
  CHECK(!rhythm.next(true));
  double t = 0;
  // with a held bead 2, 2.01, 2.02, without one 3 and 3.3
  for (double interval : {2.0, 3.0, 2.01, 3.3, 2.02}) {
    const bool held = interval < 3;
    t += interval;
    rhythm.insertion(held, t);
  }
  REQUIRE(rhythm.next(true));
  CHECK(*rhythm.next(true) == Approx(t + 2.03).epsilon(1e-14));  // round-off of six sums
  CHECK(!rhythm.next(false));
}

TEST_CASE("The first step after an event is the one that the last event of its kind would have allowed") {
  constexpr int order = 6;
  AdaptiveStep control(0.1, order);
  const auto step = [&](double h, double error) { REQUIRE(control.accepts(0, h, error)); };
  step(0.1, 0.3);
  control.event(EventKind::place);
  CHECK(control.proposal(0, 1) < 0.1);  // nothing is known yet of what follows a placement
  const double first = control.proposal(0, 1), allowed = 0.9 * first * std::pow(0.5, -1. / order);
  step(first, 0.5);
  CHECK(control.proposal(0, 1) == Approx(allowed).epsilon(1e-14));
  step(control.proposal(0, 1), 1e-8);  // what follows does not matter
  control.event(EventKind::release);
  step(control.proposal(0, 1), 1e-8);
  control.event(EventKind::place);
  CHECK(control.proposal(0, 1) == Approx(allowed).epsilon(1e-14));
}

TEST_CASE("After an event that went easily the next of its kind may begin a tenth longer, no more") {
  AdaptiveStep control(0.1, 6);
  control.event(EventKind::removal);
  REQUIRE(control.accepts(0, control.proposal(0, 1), 0.5));
  const double first = control.proposal(0, 1);
  control.event(EventKind::removal);
  REQUIRE(control.accepts(0, control.proposal(0, 1), 1e-9));
  control.event(EventKind::removal);
  CHECK(control.proposal(0, 1) == Approx(1.1 * first).epsilon(1e-14));
}

/// By a call: inlined, GCC 12 takes an event that has not been for one that is not set.
[[gnu::noinline]] static bool accepts(StepControl& control, double h, double error) {
  return control.accepts(0, h, error);
}

TEST_CASE(
    "A step is accepted with what its scheme's share permits, and does not grow right after a rejection") {
  for (double share : {1.0, 0.1}) {
    CAPTURE(share);
    AdaptiveStep control(0.1, 5, 1, share);
    CHECK_FALSE(accepts(control, 0.1, 1.01 * share));
    const double h = control.proposal(0, 1);
    CHECK(h < 0.1);
    CHECK(accepts(control, h, 0.001 * share));
    CHECK(control.proposal(0, 1) <= h);
    CHECK(accepts(control, h, 0.99 * share));
  }
}

TEST_CASE("A fixed step that would end a sliver before its grid goes on to the next place there") {
  const FixedStep control(0.1);
  // 3 * 0.1 is a little above 0.3: a run that has come to 0.3 is there
  CHECK(control.proposal(0.3, 1) == Approx(0.1).epsilon(1e-9));
  CHECK(control.proposal(0.3 - 1e-12, 1) == Approx(0.1).epsilon(1e-9));
  CHECK(control.proposal(0.25, 1) == Approx(0.05).epsilon(1e-9));
  CHECK(control.proposal(0.25, 0.27) == Approx(0.02).epsilon(1e-9));
}

TEST_CASE("A fixed step is as long after hundreds of millions of others as the first one") {
  for (const double dt : {1e-6, 3e-7, 0.1, 1.0 / 3, 7.7e-9})
    for (std::int64_t k = 100; k < 1'000'000'000; k += k / 7) {
      const FixedStep control(dt);
      const double t = double(k) * dt, never = std::numeric_limits<double>::infinity();
      // the ends of the step are rounded, each by half an epsilon of the time at the most
      CHECK(std::abs(control.proposal(t, never) / dt - 1) < 2e-16 * double(k) + 1e-9);
    }
}

TEST_CASE(
    "An adaptive step is cut by an event in its last hundredth only: one well inside gets a step of its "
    "own") {
  struct Cuts final : Observer<3> {
    void segment(const Jet<3>&, const DenseOutput<3>& s) override {
      if (s.to().t > s.until) most = std::max(most, (s.to().t - s.until) / (s.to().t - s.begin()));
    }
    double most = 0;
  } cuts;
  Run<3> run(with_tolerance(example("pvp", {"collector distance 0.05"}), 1e-6));
  run.to(2e-3, {&cuts});
  REQUIRE(run.jet().removed > 3);
  CHECK(cuts.most < 0.011);  // an event may lie in a step's extrapolation by as much
}

TEST_CASE("No step is so long that its samples keep the run from looking at signals and the clock") {
  Parameters p = with_tolerance(example("pvp"), 1e-6);
  p.print_xyz = 1e-13;  // steps of case 3 are some 1e-5 s long: 1e8 samples each
  const double longest = most_samples_of_a_step * 1e-13 / scales(p).time;
  const auto control = step_control(p);
  CHECK(control->proposal(0, 1) == Approx(longest).epsilon(1e-14));
  REQUIRE(control->accepts(0, longest, 1e-9));
  CHECK(control->proposal(0, 1) == Approx(longest).epsilon(1e-14));
}

TEST_CASE("Where the jet inserts and loses beads in a rhythm hardly any step is rejected or retaken") {
  for (double tolerance : {1e-5, 1e-6, 1e-8}) {
    Run<3> run(with_tolerance(example("pvp"), tolerance));
    const Effort e = run.to(0.03);
    CAPTURE(tolerance, e.steps, e.rejected, e.retaken);
    CHECK(e.removed > 100);
    // six steps a bead and more, of which three end on events: thrown away is less than one for four beads
    CHECK(e.rejected + e.retaken < e.steps / 24);
  }
}
