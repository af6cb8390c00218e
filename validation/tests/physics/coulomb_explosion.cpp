/// Charges that fly apart: energy, and the closed relation between time and distance.

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "forces/terms/coulomb_force.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

constexpr int all_pairs = 1 << 30;

/// When a bead with d^2x/dt^2 = k / x^2, at rest at x0, passes x: the integral of
/// dt = dx / sqrt(2 k (1/x0 - 1/x)).
double time_to(double x, double x0, double k) {
  const double s = x / x0;
  return std::sqrt(x0 * x0 * x0 / (2 * k)) * (std::sqrt(s * (s - 1)) + std::asinh(std::sqrt(s - 1)));
}

/// Kinetic and Coulomb energy of the beads and the nozzle's unit charge at the origin.
double energy(const Jet<3>& jet, double Q) {
  double e = 0;
  for (Eigen::Index i = 0; i < jet.size(); ++i) {
    e += jet.mass[i] * velocity<3>(jet.y, i).squaredNorm() / 2;
    e += Q * jet.charge[i] / position<3>(jet.y, i).norm();
    for (Eigen::Index j = 0; j < i; ++j)
      e += Q * jet.charge[i] * jet.charge[j] / (position<3>(jet.y, i) - position<3>(jet.y, j)).norm();
  }
  return e;
}

}  // namespace

TEST_CASE("A bead pushed by the nozzle's charge keeps the time-distance relation of Coulomb's law") {
  const Parameters p = plain_parameters();
  const double Q = 3, t = 2;
  std::vector<double> late;
  for (double dt : {0.02, 0.01, 0.005}) {
    auto f = equations<1>(p, CoulombForce<1>(Q, all_pairs));
    auto jet = jet_of<1>({bead_at(1)});
    march_to<1>(t, dt, jet, f, p, Scheme::rk4);
    late.push_back(std::abs(time_to(jet.y(0, 0), 1, Q) - t));
  }
  for (double order : orders(late)) CHECK(order == Approx(4).margin(0.2));  // the next term is O(dt) of it
  CHECK(late.back() <
        1e-9);  // order 4: the step resolves the initial acceleration time, 1/sqrt(3), 115 times
}

TEST_CASE("Two beads on either side of the nozzle fly apart as one bead does from 5/4 of its charge") {
  // from the nozzle Q/r^2, from the other bead Q/(2r)^2
  const Parameters p = plain_parameters();
  const double Q = 3, r0 = 0.7, t = 2;
  const Vec<3> way = Vec<3>(1, -2, 2) / 3;
  auto f = equations<3>(p, CoulombForce<3>(Q, all_pairs));
  auto jet = jet_of<3>({{r0 * way}, {-r0 * way}});
  march_to<3>(t, 0.0025, jet, f, p, Scheme::verner6);
  const Vec<3> a = position<3>(jet.y, 0), b = position<3>(jet.y, 1);
  // order 6 with 160 steps in the acceleration time: truncation is below the round-off of 800 steps
  CHECK(time_to(a.norm(), r0, 1.25 * Q) == Approx(t).epsilon(1e-12));
  CHECK((a + b).norm() < 1e-12);
  CHECK(a.cross(way).norm() < 1e-12);
}

TEST_CASE(
    "A cloud of unequal beads around the nozzle conserves its energy, the better the smaller the steps") {
  const Parameters p = plain_parameters();
  const double Q = 2;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-1, 1), some(0.5, 2);
  std::vector<Bead<3>> beads;
  for (int i = 0; i < 8; ++i) {
    const Vec<3> r(place(random), place(random), place(random));
    beads.push_back({r + r.normalized(), Vec<3>::Zero(), 0, some(random), some(random)});
  }
  std::vector<double> drift;
  for (double dt : {0.02, 0.01, 0.005}) {
    auto f = equations<3>(p, CoulombForce<3>(Q, all_pairs));
    auto jet = jet_of<3>(beads);
    const double before = energy(jet, Q);
    march_to<3>(2, dt, jet, f, p, Scheme::rk4);
    drift.push_back(std::abs(energy(jet, Q) / before - 1));
  }
  // RK4's energy error is of order 4, in smooth repulsion up to 5; the margin covers both
  for (double order : orders(drift)) CHECK(order > 3.8);
  CHECK(drift.back() < 1e-7);
}
