/// Extreme cases end in a right answer or in a clear stop, never in numbers that are not.

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "validation/support/run.hpp"

using namespace treejet;
using Catch::Matchers::Contains;

namespace {

/// What the run says when it stops; empty if it reaches its end with finite numbers.
template <int D>
std::string stop(Run<D>& run, double seconds) {
  try {
    run.to(seconds);
  } catch (const NumericalError& e) {
    CHECK(e.exit_code() == 3);
    return e.what();
  }
  REQUIRE(run.jet().y.isFinite().all());
  REQUIRE(run.jet().t == Approx(seconds / run.unit.time));
  return "";
}

template <int D>
void add_bead(Run<D>& run, const Vec<D>& r, const Vec<D>& v = Vec<D>::Zero()) {
  append<D>(run.scene.jet, {r, v});
}

/// A stop names the bead, the time and a cause.
void check_clear(const std::string& message) {
  CHECK_THAT(message, Contains("at scaled time"));
  CHECK_THAT(message, Contains("bead"));
  CHECK_THAT(message, Contains("likely cause"));
}

}  // namespace

TEST_CASE("Two beads at the same place stop the run at once, and both are named") {
  Run<3> run(with_steps(example("pvp"), Scheme::heun, 1e-7));
  add_bead<3>(run, position<3>(run.jet().y, 0));
  const std::string what = stop(run, 1e-3);
  check_clear(what);
  CHECK_THAT(what, Contains("beads 0 and 1 have met"));
}

TEST_CASE(
    "Under error control two beads at the same place, or one at the nozzle's point charge, stop the run") {
  Run<3> two(with_tolerance(example("pvp"), 1e-6));
  add_bead<3>(two, position<3>(two.jet().y, 0));
  CHECK_THAT(stop(two, 1e-3), Contains("beads 0 and 1 have met"));
  Run<1> one(with_tolerance(example("straight-jet"), 1e-6));
  one.scene.jet.y(0, 0) = 0;
  CHECK_THAT(stop(one, 1e-3), Contains("at scaled time"));
}

TEST_CASE("A step control that gives up names the bead and the likely cause") {
  Run<3> two(with_tolerance(example("pvp"), 1e-6));
  add_bead<3>(two, position<3>(two.jet().y, 0));
  check_clear(stop(two, 1e-3));
}

TEST_CASE("Beads of a straight jet that cross stop the run") {
  // the upper bead is faster than charge and stress can hold back within a step
  Run<1> run(with_steps(example("straight-jet"), Scheme::heun, 1e-4));
  run.scene.jet.y(0, 0) = 10;
  add_bead<1>(run, Vec<1>(9), Vec<1>(1e4));
  const std::string what = stop(run, 1e-2);
  check_clear(what);
  CHECK_THAT(what, Contains("crossed"));
}

TEST_CASE("A time step a thousand times too large ends in a clear stop, whichever way events are seen") {
  // accurate steps are 1e-6 s; JETSPIN's 1e-8
  for (EventRule events : {EventRule::located, EventRule::step})
    for (Scheme scheme : {Scheme::euler, Scheme::heun, Scheme::rk4}) {
      Parameters p = with_steps(example("pvp"), scheme, 1e-3);
      p.events = events;
      CAPTURE(name(scheme), int(events));
      Run<3> run(p);
      const std::string what = stop(run, 0.05);
      check_clear(what);
      Parameters q = with_steps(example("straight-jet"), scheme, 0.05);
      q.events = events;
      Run<1> straight(q);
      check_clear(stop(straight, 2));
    }
}

TEST_CASE("A tolerance of 1e-14 is met or refused, and what is met agrees with a run at 1e-10") {
  Run<3> strict(with_tolerance(example("pvp"), 1e-14)), usual(with_tolerance(example("pvp"), 1e-10));
  const std::string what = stop(strict, 5e-4);
  if (what.empty()) {
    usual.to(5e-4);
    REQUIRE(strict.jet().size() == usual.jet().size());
    // 20 events' worth of the looser run's error
    CHECK((strict.jet().y - usual.jet().y).abs().maxCoeff() < 1e-7);
  } else {
    CHECK_THAT(what, Contains("tolerance"));
  }
}

TEST_CASE("A single bead with insertion and a jet that never reaches the collector go on to the end") {
  Parameters p = with_tolerance(example("pvp"), 1e-6);
  p.collector_distance = 1e6;
  p.external_potential *= 1e6 / 16;
  Run<3> run(p);
  CHECK(stop(run, 4e-3) == "");
  CHECK(run.jet().removed == 0);
  CHECK(run.beads() == 57);  // as with the collector at 16 cm, which no bead has reached by then
}

TEST_CASE("Without insertion the collector empties the jet and the run ends there") {
  for (EventRule events : {EventRule::located, EventRule::step}) {
    Parameters p = example("single-bead");
    p.initial_length = 0.9;
    p.points = 3;
    p.collector_distance = 2;
    p.external_potential = 100;
    p.removing = true;
    p.events = events;
    Run<1> run(with_steps(p, Scheme::rk4, 1e-5));
    const Effort effort = run.to(1);
    CHECK(effort.removed == 3);
    CHECK(run.jet().size() == 0);
    CHECK(run.jet().t * run.unit.time < 1);  // the time of the last arrival
  }
}

TEST_CASE("A jet without charge falls into the collector and is fed by gravity alone") {
  for (int system : {1, 3}) {
    Parameters p = with_tolerance(example("pvp"), 1e-6);
    p.system = system;
    p.perturb = p.perturb && system == 3;
    p.density_charge = 0;
    p.viscosity = p.elastic_modulus = 1;  // a fluid thin enough to fall
    p.surface_tension = 0;
    p.collector_distance = 1;
    const auto check = [](auto&& run) {
      CHECK(stop(run, 0.2) == "");
      CHECK(run.jet().removed > 0);
      CHECK(run.beads() > 1);
    };
    if (system == 1)
      check(Run<1>(p));
    else
      check(Run<3>(p));
  }
}

TEST_CASE("An element stretched a million times keeps finite forces") {
  Parameters p = with_tolerance(example("pvp"), 1e-6);
  p.collector_distance = 1e9;
  p.inserting = false;
  Run<3> run(p);
  run.scene.jet.y(0, 0) *= 1e6;
  add_bead<3>(run, Vec<3>(1, 0.1, 0));
  CHECK(stop(run, 1e-3) == "");
}

TEST_CASE("Two beads at one place stop a run by a tree, which leaves such a pair out") {
  Run<3> run(with_steps(example("pvp", {"points 900", "initial length 12.", "inserting no", "coulomb tree",
                                        "coulomb accuracy 1.d-3"}),
                        Scheme::heun, 1e-9));
  run.scene.jet.y.row(400).head<3>() = run.scene.jet.y.row(100).head<3>();
  CHECK_THAT(stop(run, 1e-6), Contains("at one place"));
}
