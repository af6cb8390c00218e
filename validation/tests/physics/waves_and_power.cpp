/// Closed answers of tensions: waves on a thread under surface tension, and where the power of rubber goes.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "forces/terms/laws/oldroyd_b.hpp"
#include "forces/terms/surface_energy.hpp"
#include "forces/terms/viscoelastic.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// A straight thread of elements of length and mass 1, its beads displaced along an axis by small * sin(k x).
Jet<3> waving(int beads, double k, int axis, double small) {
  std::vector<Bead<3>> row;
  for (int i = beads; i >= 1; --i) {
    Vec<3> r(i, 0, 0);
    r[axis] += small * std::sin(k * i);
    row.push_back(Bead<3>(r));
  }
  return jet_of<3>(row);
}

/// s^2 of a wave along an axis: acceleration over displacement of a bead in the middle.
double growth(double k, int axis, double radius, double alpha) {
  constexpr int beads = 80, middle = 37;
  constexpr double small = 1e-5;
  auto f = equations<3>(plain_parameters(), SurfaceEnergy<3>(alpha, Section{radius, 1}));
  const Jet<3> jet = waving(beads, k, axis, small);
  const double displaced = small * std::sin(k * (beads - middle));
  return slope(f, jet)(middle, velocity_column<3> + axis) / displaced;
}

}  // namespace

TEST_CASE(
    "A thread under surface tension swings at k sqrt(alpha / (rho a)) and necks at k sqrt(alpha / (2 rho "
    "a))") {
  const double a = 0.02, alpha = 0.7, rho = 1 / (std::numbers::pi * a * a);  // elements of mass 1
  for (const auto& [axis, theory] : {std::pair{1, -alpha / (rho * a)}, std::pair{0, alpha / (2 * rho * a)}}) {
    CAPTURE(axis);
    const auto error = [&, axis = axis, theory = theory](double k) {
      return growth(k, axis, a, alpha) / (k * k * theory) - 1;
    };
    // a row of beads has the second difference for the second derivative: (k l)^2 / 12 less, and that squared
    for (const double k : {0.3, 0.15}) CHECK(error(k) == Approx(-k * k / 12).epsilon(k * k / 20 + 1e-3));
    CHECK(error(0.3) / error(0.15) == Approx(4).epsilon(0.02));
  }
}

TEST_CASE(
    "What a chain of Oldroyd's fluid loses in kinetic and elastic energy is the elastic one over its time") {
  // of an element, over its volume: (A_xx + 2 A_rr - 3) / 6 = (sigma + A_rr - 1) / 2, which changes by
  // sigma r - itself as A relaxes
  const double coefficient = 1.7;
  auto law = std::make_unique<ElementLaw<3, OldroydB>>(OldroydB{});
  const Nozzle<3> nozzle(plain_parameters(), law->columns());
  std::vector<std::unique_ptr<ForceTerm<3>>> terms;
  terms.push_back(std::make_unique<Viscoelastic<3>>(1, coefficient));
  EquationsOfMotion<3> f(nozzle, std::move(law), std::move(terms), nullptr, Threads{1});
  Jet<3> jet = jet_of<3>({with_added<3>({Vec<3>(4.2, 0.3, -0.2), Vec<3>(2, -1, 0.5), 1.9, 0.7}, -0.3),
                          with_added<3>({Vec<3>(3.1, -0.2, 0.4), Vec<3>(1.5, 0.8, -0.6), -0.2, 1.3}, 0.4),
                          with_added<3>({Vec<3>(1.9, 0.5, 0.1), Vec<3>(-0.4, 0.2, 0.9), 40, 1.1}, -2),
                          with_added<3>({Vec<3>(0.8, 0.1, 0.3), Vec<3>(0.6, -0.7, 0.3), 0.1, 1}, 0)});
  const State<3> rates = slope(f, jet);
  double power = 0, elastic = 0, largest = 0;
  for (Eigen::Index i = 0; i < jet.size(); ++i) {
    const double kinetic = jet.mass[i] * velocity<3>(jet.y, i).dot(velocity<3>(rates, i));
    const double A_rr = std::exp(jet.y(i, own_columns<3>)), sigma = jet.y(i, stress_column<3>);
    const double stored =
        coefficient * jet.volume[i] / 2 * (rates(i, stress_column<3>) + A_rr * rates(i, own_columns<3>));
    power += kinetic + stored;
    largest = std::max({largest, std::abs(kinetic), std::abs(stored)});
    elastic += coefficient * jet.volume[i] * (sigma + A_rr - 1) / 2;
  }
  CHECK(std::abs(power + elastic) < 1e-14 * largest);  // round-off of a few sums
  CHECK(elastic > 0.1 * largest);
}
