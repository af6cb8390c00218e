/// The self-field of a slender jet that dries: its charge stays while its volume goes.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "forces/terms/evaporation.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

constexpr double Q = 2, polymer = 0.1, radius = 1e-2;

Parameters fluid() {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.evaporation = true;
  p.polymer_fraction = polymer;
  return p;
}

/// Beads that have `left` of their volumes.
Jet<3> dried(const std::vector<Bead<3>>& beads, const std::vector<double>& left) {
  std::vector<Bead<3>> with_solvent;
  for (std::size_t i = 0; i < beads.size(); ++i)
    with_solvent.push_back(with_added<3>(beads[i], left[i] - polymer));
  return jet_of<3>(with_solvent);
}

/// The equations of motion with the self-field alone, of a fluid that dries or of one that does not.
EquationsOfMotion<3> self_field(const Parameters& p, const Section& section, bool dries,
                                bool uneven = false) {
  const Evaporation evaporation(p);
  Columns columns;
  if (dries) columns.push_back(SolventColumn<3>(evaporation).column());
  std::vector<std::unique_ptr<ForceTerm<3>>> terms;
  terms.push_back(std::make_unique<SlenderSelfField<3>>(
      Q, section, uneven, dries ? std::optional<Evaporation>(evaporation) : std::nullopt));
  EquationsOfMotion<3> f(Nozzle<3>(p, columns), std::make_unique<Maxwell<3>>(), std::move(terms), nullptr,
                         Threads{1});
  if (dries) f.add_column(std::make_unique<SolventColumn<3>>(evaporation));
  return f;
}

const std::vector<Bead<3>> crooked = {{Vec<3>(9.1, 0.6, -0.4), Vec<3>(0, 0, 0), 0, 0.7},
                                      {Vec<3>(6.2, -0.4, 0.8), Vec<3>(0, 0, 0), 0, 1.3},
                                      {Vec<3>(3.8, 1, 0.2), Vec<3>(0, 0, 0), 0, 1.1},
                                      {Vec<3>(1.7, 0.2, 0.6), Vec<3>(0, 0, 0)}};

}  // namespace

TEST_CASE(
    "A jet that has dried alike everywhere has the self-field of a thinner one with all of its charge") {
  constexpr double left = 0.3;
  Parameters by_flow = fluid();
  by_flow.feed = Feed::flow;
  by_flow.flow_rate = 0.01;
  for (const Parameters& p : {fluid(), by_flow})
    for (const bool held : {false, true}) {
      Jet<3> dry = dried(crooked, {left, left, left, left}), thin = jet_of<3>(crooked);
      if (p.feed == Feed::flow && !held) continue;  // always holds one
      for (Jet<3>* jet : {&dry, &thin}) {
        jet->held = held;
        if (p.feed == Feed::flow) jet->t = 0.4 / Nozzle<3>(p).feed().flow();
      }
      const Section section{radius, 1}, of_less{radius * std::sqrt(left), 1};
      auto f = self_field(p, section, true), of_thin = self_field(p, of_less, false);
      const auto a = slope(f, dry).middleCols<3>(velocity_column<3>).eval(),
                 b = slope(of_thin, thin).middleCols<3>(velocity_column<3>).eval();
      CAPTURE(held);
      // all but the youngest: a held bead shares what the nozzle bears by masses, of which one has dried
      const Eigen::Index rows = p.feed == Feed::flow ? 3 : 4;
      CHECK((left * a - b).topRows(rows).abs().maxCoeff() < 1e-13 * b.abs().maxCoeff());  // round-off
      if (held && p.feed == Feed::pull) continue;  // not an energy's force: the tension goes over
      const SlenderSelfField<3> dry_term(Q, section, false, Evaporation(p)),
          thin_term(Q, of_less, false, std::nullopt);
      // the youngest element counts, too; round-off
      CHECK(dry_term.energy(f.chain()) == Approx(thin_term.energy(of_thin.chain())).epsilon(1e-13));
    }
}

TEST_CASE("The tension of a drying element is that of its charge on the radius that is left") {
  const std::vector<double> left = {0.2, 0.7};
  auto f = self_field(fluid(), Section{radius, 1}, true);
  const Jet<3> jet = dried({{Vec<3>(60, 0, 0), Vec<3>(0, 0, 0), 0, 0.8}, {Vec<3>(10, 0, 0)}}, left);
  const double l = 50, a = radius * std::sqrt(left[0] / l),
               charges = 1 / 0.8;  // c of the bead that weighs 0.8
  const double T = Q * charges / (l * l) * (1.5 - std::log(2 * l / a) + std::numbers::egamma);
  // it pulls where it is positive: away from the collector
  CHECK(slope(f, jet)(0, velocity_column<3>) == Approx(-T / (0.8 * left[0])).epsilon(1e-13));  // round-off
}

TEST_CASE("The self-field of elements that have dried differently follows from its energy") {
  for (const bool uneven : {false, true}) {
    auto f = self_field(fluid(), Section{radius, 1}, true, uneven);
    const std::vector<double> left = {0.15, 0.3, 0.6, 0.95};
    Jet<3> jet = dried(crooked, left);
    if (uneven) jet.volume.head(2) = 0.5;
    const SlenderSelfField<3> term(Q, Section{radius, 1}, uneven, Evaporation(fluid()));
    const State<3> rates = slope(f, jet);
    const double h = 1e-4;
    for (Eigen::Index i = 0; i < jet.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const auto energy = [&](double off) {
          Jet<3> moved = jet;
          moved.y(i, k) += off;
          slope(f, moved);
          return term.energy(f.chain());
        };
        const double force = jet.mass[i] * left[std::size_t(i)] * rates(i, velocity_column<3> + k);
        // central differences err by h^2 / l^2 times a few
        CHECK(force == Approx(-(energy(h) - energy(-h)) / (2 * h)).margin(1e-7));
      }
  }
}

TEST_CASE("Where elements of unequal length meet a jet that dries feels the joint of its charges") {
  const auto joints = [](const std::vector<double>& left, bool dries) {
    Jet<3> jet = dries ? dried(crooked, left) : jet_of<3>(crooked);
    jet.volume.head(2) = 0.5;
    auto even = self_field(fluid(), Section{radius, 1}, dries, false),
         uneven = self_field(fluid(), Section{radius, 1}, dries, true);
    State<3> force = slope(uneven, jet) - slope(even, jet);
    for (Eigen::Index i = 0; i < jet.size(); ++i)
      force.row(i) *= jet.mass[i] * (dries ? left[std::size_t(i)] : 1);
    return force.middleCols<3>(velocity_column<3>).eval();
  };
  const auto fresh = joints({}, false), dry = joints({0.15, 0.3, 0.6, 0.95}, true);
  CHECK(fresh.abs().maxCoeff() > 1e-3);
  CHECK((dry - fresh).abs().maxCoeff() < 1e-13);  // round-off: charges are frozen
}

TEST_CASE(
    "A slender jet that is fed by flow and dries is the same by the scheme that solves for its local terms") {
  const auto jet_by = [](const char* scheme) {
    const std::vector<std::string> lines = {"model slender",
                                            "dynamic refinement yes",
                                            "dynamic refinement tolerance 1.d-3",
                                            "flow rate 60 mL/h",
                                            "evaporation yes",
                                            "evaporation model vapour",
                                            "evaporation polymer frac 0.06",
                                            "evaporation diffusivity 200",
                                            fmt::format("integrator {}", scheme)};
    Run<3> run(with_tolerance(example("pvp", lines), 1e-7));
    run.to(3e-3);
    return run.jet().y;
  };
  const State<3> one = jet_by("verner6"), other = jet_by("kencarp5");
  REQUIRE(one.rows() == other.rows());
  CHECK(one.col(own_columns<3>).minCoeff() < 0.7);  // a quarter of the solvent has gone
  const double unit = scales(example("pvp")).length;
  // 1e-7 of the collector distance, and what locating some 60 releases adds
  CHECK(unit * (one - other).leftCols<3>().abs().maxCoeff() < 1e-5);
}
