/// What `treejet check` foretells from a trial.

#include <catch2/catch.hpp>

#include "core/jet/observer.hpp"
#include "core/jet/scales.hpp"
#include "integrators/run/cost_estimate.hpp"
#include "integrators/run/trial_run.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// A jet in its steady state: by scaled time t 40 t beads in, 40 t evaluations a bead, 1e-3 s each.
TrialSample at(double t, double seconds) {
  TrialSample s;
  s.t = t, s.seconds = seconds, s.beads = 150, s.x = 400, s.v = 20;
  s.inserted = static_cast<std::int64_t>(40 * t), s.removed = s.inserted, s.steps = 5 * s.inserted;
  s.evaluations = 40 * s.inserted;
  return s;
}

Trial trial(const std::vector<TrialSample>& samples) {
  Trial t;
  t.samples = samples;
  return t;
}

}  // namespace

TEST_CASE("A trial that could not end, or would not fit into memory, is refused before anything is made") {
  const auto beads = [](const char* points, const char* sum) { return example("pvp", {points, sum}); };
  CHECK_NOTHROW(expect_feasible_trial(beads("points 60000", "coulomb direct")));
  CHECK_NOTHROW(expect_feasible_trial(beads("points 1000000", "coulomb auto")));
  CHECK_THROWS_WITH(expect_feasible_trial(beads("points 1000000", "coulomb direct")),
                    Catch::Contains("1e+12 pairs") && Catch::Contains("did you mean coulomb auto?"));
  CHECK_NOTHROW(expect_feasible_trial(example("pvp", {"points 1000000", "cutoff 0.1"})));
  // 4 kB a bead: 410 GB
  CHECK_THROWS_WITH(expect_feasible_trial(beads("points 100000000", "coulomb auto")),
                    Catch::Contains("1e+08 beads at the start need up to 410 GB"));
}

TEST_CASE("A trial tells when the first bead arrived, not when it looked next") {
  const Parameters p = with_tolerance(example("pvp", {"collector distance 0.3"}), 1e-6);
  struct Arrival final : Observer<3> {
    void event(EventKind kind, const Jet<3>& jet) override {
      if (kind == EventKind::removal && !at) at = jet.t;
    }
    std::optional<double> at;
  } arrival;
  Run<3> whole(p), tried(p);
  whole.to(0.008, {&arrival});
  REQUIRE(arrival.at);
  const Trial found = trial_run<3>(p, system(tried.scene), /*seconds*/ 0.5);
  REQUIRE(found.first_arrival);
  CHECK(*found.first_arrival == *arrival.at);
  CHECK(*plan(p, found, true).first_arrival == *arrival.at * whole.unit.time);
}

TEST_CASE("A plan is a trial's rates carried on to the end, also if the machine stalled in the trial") {
  const Parameters p = example("pvp");
  const double end = p.final_time / scales(p).time;
  const Trial smooth = trial({at(0, 0), at(1, 1.6), at(2, 3.2), at(3, 4.8), at(4, 6.4), at(4, 6.4)});
  // nothing but a stall of three quarters of the trial stands between the last two samples with different t
  const Trial stalled = trial({at(0, 0), at(1, 1.6), at(2, 3.2), at(3, 4.8), at(4, 24), at(4, 24)});
  // a single step took the whole trial
  const Trial one_step = trial({at(0, 0), at(4, 6.4)});
  for (const Trial& t : {smooth, stalled, one_step}) {
    const Plan foretold = plan(p, t, false);
    CHECK(foretold.inserted == Approx(40 * end).epsilon(1e-9));
    CHECK(foretold.evaluations == Approx(1600 * end).epsilon(1e-9));
    CHECK(foretold.steps == Approx(200 * end).epsilon(1e-9));
    CHECK(foretold.most_beads == 150);
  }
  CHECK(plan(p, smooth, false).seconds == Approx(1.6 * end).epsilon(1e-9));
  CHECK(plan(p, one_step, false).seconds == Approx(1.6 * end).epsilon(1e-9));
}

TEST_CASE("Once beads arrive a plan carries on their mean number since then, not the last one") {
  const Parameters p = example("pvp");
  const double end = p.final_time / scales(p).time;
  std::vector<TrialSample> samples = {at(0, 0), at(1, 1.6), at(2, 3.2), at(3, 4.8), at(4, 6.4)};
  const std::int64_t beads[] = {0, 100, 140, 120, 160};  // whips, as a jet does
  for (std::size_t k = 0; k < samples.size(); ++k) samples[k].beads = beads[k];
  const double mean = (100 + 140 + 120 + 160) / 4.0;
  CHECK(plan(p, trial(samples), false).mean_beads ==
        Approx((100 + 140 + 120 + 160 + mean * (end - 4)) / end).epsilon(1e-9));
}
