/// Parts of forces that act on little: held beads, growing elements, unequal radii, drying beads.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/jet/refinement.hpp"
#include "forces/terms/air_drag.hpp"
#include "forces/terms/evaporation.hpp"
#include "forces/terms/external_field.hpp"
#include "forces/terms/gravity.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "forces/terms/surface_tension.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

constexpr double round_off = 1e-14;

/// A column that nothing changes.
struct Constant final : ColumnRate<3> {
  Column column() const override { return {.name = "dye", .unit = "1", .at_birth = 0.9}; }
  void set(const Chain<3>&, int, Rows, Eigen::Ref<Eigen::ArrayXd> rate) const override { rate.setZero(); }
};

Parameters fed() {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.feed = Feed::flow;
  p.flow_rate = 0.01;
  return p;
}

}  // namespace

TEST_CASE("Gravity and the needle's field act on a held bead as on one that stands there") {
  const Nozzle<3> nozzle(fed());
  Jet<3> jet = jet_of<3>({Bead<3>({2, 0.4, 0})});
  jet.held = true;
  jet.t = 0.5 / nozzle.feed().flow();
  const Chain<3> chain = chain_of<3>(jet, nozzle);
  CHECK(Gravity<3>(2).on_held(chain) == Vec<3>(2, 0, 0));
  const NeedlePlate<3> needle(1.7, NeedleField(0.1, 20), Waveform());
  const Vec<3> place = chain.point.row(1).matrix().transpose();
  CHECK((needle.on_held(chain) - 1.7 * NeedleField(0.1, 20)(place)).norm() < round_off);
  CHECK(needle.on_held(chain).norm() > 0);
}

TEST_CASE("Fluid enters the youngest element with the columns it has at birth") {
  const Nozzle<3> nozzle(fed(), {Constant().column()});
  EquationsOfMotion<3> f(nozzle, std::make_unique<Maxwell<3>>(), {}, nullptr, Threads{1});
  f.add_column(std::make_unique<Constant>());
  Jet<3> jet = jet_of<3>({with_added<3>(Vec<3>(1.5, 0, 0), 0.3)});
  jet.held = true;
  jet.t = 0.25 / nozzle.feed().flow();
  State<3> slope;
  f(jet, jet.t, jet.y, slope);
  // mixed into 1.25 of volume
  CHECK(slope(0, own_columns<3>) == Approx(nozzle.feed().flow() / 1.25 * (0.9 - 0.3)).epsilon(round_off));
}

TEST_CASE("An element that grows is no joint") {
  const Section section{0.05, 1};
  const Nozzle<3> nozzle(fed());
  Jet<3> jet = jet_of<3>({Bead<3>({3.4, 0, 0}), Bead<3>({2.4, 0, 0}), Bead<3>({1.4, 0, 0})});
  jet.held = true;
  jet.t = 0.4 / nozzle.feed().flow();
  const auto push = [&](bool uneven) {
    std::vector<std::unique_ptr<ForceTerm<3>>> terms;
    terms.push_back(std::make_unique<SlenderSelfField<3>>(2, section, uneven));
    EquationsOfMotion<3> f(nozzle, std::make_unique<Maxwell<3>>(), std::move(terms), nullptr, Threads{1});
    return slope(f, jet);
  };
  CHECK((push(true) == push(false)).all());
}

TEST_CASE("A bead that has dried to half its mass is pushed twice as fast") {
  Parameters p = plain_parameters();
  p.polymer_fraction = 0.1;
  p.nozzle_cross = 0.1;
  const Evaporation evaporation(p);
  const Columns columns = {SolventColumn<3>(evaporation).column()};
  std::vector<std::unique_ptr<ForceTerm<3>>> terms;
  terms.push_back(std::make_unique<ElectricField<3>>(0.8));
  EquationsOfMotion<3> f(Nozzle<3>(p, columns), std::make_unique<Maxwell<3>>(), std::move(terms), nullptr,
                         Threads{1});
  f.add_column(std::make_unique<SolventColumn<3>>(evaporation));
  const Jet<3> jet = jet_of<3>({with_added<3>(Vec<3>(1.5, 0, 0), 0.4)});
  CHECK(slope(f, jet)(0, velocity_column<3>) == Approx(0.8 / 0.5).epsilon(round_off));
}

TEST_CASE("The lift of a bend goes by the square of the mean radius of its two elements") {
  const Gas gas{0.7, 0.1, 0};
  const Section section{0.1, 1};
  // an element four times as long as the other, of half its radius
  Jet<3> jet = jet_of<3>({Bead<3>({4, 1, 0}, {0, 0, 0}), Bead<3>({0, 1, 0}, {0, 3, 0})});
  const Nozzle<3> nozzle(plain_parameters());
  const Chain<3> chain = chain_of<3>(jet, nozzle);
  State<3> slope(2, own_columns<3>);
  slope.setZero();
  Acceleration<3> a = slope.middleCols<3>(velocity_column<3>);
  AirLift(gas, section).add(chain, {0, 2}, a);
  const double upper = 0.1, lower = 0.05, mean = (upper + lower) / 2;
  const Triple k = curvature({0.25, 0, 0}, {0, -1, 0});
  for (int c : {0, 1, 2})
    CHECK(a(1, c) == Approx(-0.7 * std::numbers::pi * mean * mean * 9 * k[std::size_t(c)]).epsilon(1e-12));
}

TEST_CASE("The halves of a split continue the stress of their neighbours") {
  Jet<3> jet;
  for (int i = 0; i < 8; ++i) append<3>(jet, Bead<3>(Vec<3>(8 - i, 0, 0), Vec<3>::Zero(), i));
  split<3>(jet, {3});
  CHECK(jet.y(3, stress_column<3>) == Approx(2.75).epsilon(round_off));
  CHECK(jet.y(4, stress_column<3>) == Approx(3.25).epsilon(round_off));
}
