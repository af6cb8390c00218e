/// Charge and mass over insertion and removal, and the sums of the statistics' windows.

#include <catch2/catch.hpp>

#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// Paper case 3 with the collector at 1 cm in the same field: beads arrive from about 1 ms on.
Parameters near_collector() {
  Parameters p = example("pvp");
  p.external_potential /= 16;
  p.collector_distance = 1;
  return with_tolerance(p, 1e-6);
}

/// Checks at each event what must be true of it.
template <int D>
struct Ledger final : Observer<D> {
  explicit Ledger(const Collector& c) : collector(c) {}
  void start(const Jet<D>& jet) override { initial = jet.size(); }
  void event(EventKind kind, const Jet<D>& jet) override {
    if (kind == EventKind::place) ++placed;
    if (kind == EventKind::release) ++released;
    if (kind == EventKind::removal) {
      ++removed;
      // located to the round-off of x = H
      CHECK(std::abs(collector.overdue(jet.y(0, 0))) < 1e-10 * collector.distance());
    }
    CHECK(jet.held == (placed > released));
    const Eigen::Index on_jet = initial + released - removed + (kind == EventKind::removal);
    CHECK(jet.size() == on_jet);
    CHECK(jet.charge.sum() == double(on_jet));
    CHECK(jet.mass.sum() == double(on_jet));
  }
  const Collector& collector;
  Eigen::Index initial = 0, placed = 0, released = 0, removed = 0;
};

}  // namespace

TEST_CASE("Charge and mass placed less removed are on the jet after every event") {
  Run<3> run(near_collector());
  Ledger<3> ledger(run.scene.collector);
  const Effort effort = run.to(2e-3, {&ledger});
  REQUIRE(ledger.removed >= 10);
  CHECK(effort.placed == ledger.placed);
  CHECK(effort.removed == ledger.removed);
  CHECK(run.jet().removed == ledger.removed);
  CHECK(run.beads() == 1 + ledger.placed - ledger.removed);
}

TEST_CASE("The windows of statdat.dat add up to what was placed and removed, whatever their length") {
  for (double window : {1e-4, 3.7e-4, 2e-3}) {
    CAPTURE(window);
    Run<3> run(near_collector());
    Ledger<3> ledger(run.scene.collector);
    const double end = window * std::round(2e-3 / window);
    const auto rows = recorded<3>(run, {"t", "chn", "chc", "curn", "curc", "mfn", "mfc", "fcn", "fcc"},
                                  window, end, {&ledger});
    REQUIRE(rows.size() == std::size_t(std::lround(end / window)) + 1);
    std::vector<double> sum(rows[0].size());
    for (std::size_t k = 1; k < rows.size(); ++k) {
      CHECK(rows[k][0] == Approx(double(k) * window).epsilon(1e-12));
      sum[1] += rows[k][1];
      sum[2] += rows[k][2];
      for (std::size_t c = 3; c < sum.size(); ++c) sum[c] += rows[k][c] * window;
    }
    const double q = run.unit.charge, m = run.unit.mass;
    const double round_off = 1e-12;
    CHECK(sum[1] == Approx(q * double(ledger.placed)).epsilon(round_off));
    CHECK(sum[2] == Approx(q * double(ledger.removed)).epsilon(round_off));
    CHECK(sum[3] == Approx(sum[1]).epsilon(round_off));
    CHECK(sum[4] == Approx(sum[2]).epsilon(round_off));
    CHECK(sum[5] == Approx(m * double(ledger.placed)).epsilon(round_off));
    CHECK(sum[6] == Approx(m * double(ledger.removed)).epsilon(round_off));
    // fcn and fcc count the part of a bead that is on its way: never more than one bead away from the whole
    // ones
    CHECK(std::abs(sum[7] - sum[1]) < q);
    CHECK(std::abs(sum[8] - sum[2]) < q);
  }
}
