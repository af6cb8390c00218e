/// Orders of convergence over whole runs with insertions and removals.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// Case 3 with the collector at 1 cm in the same field: to 1.5 ms some 20 insertions and 7 removals.
struct NearPvp {
  static constexpr int dimension = 3;
  static constexpr double end = 1.5e-3;
  static Parameters parameters() {
    Parameters p = example("pvp");
    p.external_potential /= 16;
    p.collector_distance = 1;
    return p;
  }
};

/// Case 2 with the collector at 2 cm in the same field.
struct NearStraight {
  static constexpr int dimension = 1;
  static constexpr double end = 0.02;
  static Parameters parameters() {
    Parameters p = example("straight-jet");
    p.external_potential /= 100;
    p.collector_distance = 2;
    return p;
  }
};

/// The same cases fed by flow, in elements long enough for the slender model.
struct FedStraight : NearStraight {
  static Parameters parameters() {
    Parameters p = example("straight-jet", {"model slender", "flow rate 0.07"});
    p.external_potential /= 100;
    p.collector_distance = 2;
    return p;
  }
};
struct FedPvp : NearPvp {
  static constexpr double end = 2.4e-3;  // longer, for its elements are
  static Parameters parameters() {
    Parameters p = example("pvp", {"model slender", "flow rate 60 mL/h", "initial length 0.04"});
    p.external_potential /= 16;
    p.collector_distance = 1;
    return p;
  }
};

template <class Case>
std::vector<double> errors(Scheme scheme, EventRule events, const std::vector<double>& steps) {
  constexpr int D = Case::dimension;
  static const State<D> reference = [] {
    // order 4 of the events at least, with steps 4 times below the finest of RK4: 1/256 of its error
    Run<D> run(with_steps(Case::parameters(), Scheme::verner6, Case::end / 25600));
    const Effort effort = run.to(Case::end);
    REQUIRE(effort.removed >= 5);
    REQUIRE(effort.released >= 10);
    return run.jet().y;
  }();
  std::vector<double> e;
  for (double h : steps) {
    Parameters p = with_steps(Case::parameters(), scheme, h);
    p.events = events;
    Run<D> run(p);
    run.to(Case::end);
    REQUIRE(run.jet().size() == reference.rows());
    e.push_back((run.jet().y - reference).template leftCols<2 * D>().abs().maxCoeff());
  }
  return e;
}

/// The mean order over the steps: where events fall within a step differs from step to step, so that single
/// ratios scatter.
double mean_order(const std::vector<double>& errors) {
  return std::log2(errors.front() / errors.back()) / double(errors.size() - 1);
}

std::vector<double> halved(double first, int count) {
  std::vector<double> h;
  for (int k = 0; k < count; ++k) h.push_back(first / (1 << k));
  return h;
}

}  // namespace

TEMPLATE_TEST_CASE(
    "With located events the schemes keep their orders 1, 2 and 4 over insertions and removals", "",
    NearStraight, NearPvp) {
  const double unit = TestType::end;
  const std::map<Scheme, std::vector<double>> steps{{Scheme::euler, halved(unit / 8000, 3)},
                                                    {Scheme::heun, halved(unit / 1000, 4)},
                                                    {Scheme::rk4, halved(unit / 200, 6)}};
  for (const auto& [scheme, h] : steps) {
    const auto e = errors<TestType>(scheme, EventRule::located, h);
    CAPTURE(name(scheme), e);
    CHECK(mean_order(e) == Approx(stepper<1>(scheme)->order()).margin(0.3));
  }
}

TEMPLATE_TEST_CASE("Fed by flow the schemes keep their orders as well", "", FedStraight, FedPvp) {
  for (const auto& [scheme, h] : {std::pair{Scheme::heun, halved(TestType::end / 1000, 4)},
                                  std::pair{Scheme::rk4, halved(TestType::end / 200, 5)}}) {
    const auto e = errors<TestType>(scheme, EventRule::located, h);
    CAPTURE(name(scheme), e);
    CHECK(mean_order(e) == Approx(stepper<1>(scheme)->order()).margin(0.3));
  }
}

TEMPLATE_TEST_CASE("With events seen at step ends every scheme is of first order", "", NearStraight,
                   NearPvp) {
  for (Scheme scheme : {Scheme::heun, Scheme::rk4}) {
    const auto e = errors<TestType>(scheme, EventRule::step, halved(TestType::end / 1600, 6));
    CAPTURE(name(scheme), e);
    CHECK(mean_order(e) == Approx(1).margin(0.3));
  }
}

TEST_CASE("Events of a step happen in their order, each at its own time") {
  // no force: beads 0.3 cm apart at 7 cm/s to a collector at 1 cm, in steps of half an interval
  Parameters p = example("single-bead");
  p.density_charge = 0;
  p.elastic_modulus = p.viscosity = 1e-9;  // too thin to be felt
  p.nozzle_velocity = 7;
  p.initial_length = 0.6;
  p.points = 2;
  p.collector_distance = 1;
  p.removing = p.inserting = true;
  struct Times final : Observer<1> {
    void event(EventKind kind, const Jet<1>& jet) override {
      all.push_back(jet.t);
      by_kind[static_cast<std::size_t>(kind)].push_back(jet.t);
    }
    std::vector<double> all;
    std::array<std::vector<double>, 4> by_kind;
  } times;
  Run<1> run(with_steps(p, Scheme::rk4, 0.02));
  run.to(0.3, {&times});
  CHECK(std::is_sorted(times.all.begin(), times.all.end()));
  const auto expect = [&](EventKind kind, double first) {
    const auto& found = times.by_kind[static_cast<std::size_t>(kind)];
    REQUIRE(found.size() > 4);
    for (std::size_t k = 0; k < found.size(); ++k)  // motion is uniform, and so met exactly but for round-off
      CHECK(found[k] * run.unit.time == Approx((first + 0.3 * double(k)) / 7).epsilon(1e-10));
  };
  expect(EventKind::place, 0.15);  // at 1.5 elements from the nozzle, from one on
  expect(EventKind::release, 0.3);
  expect(EventKind::removal, 0.4);
}
