/// Newton's third law: what the beads do to each other and to the nozzle sums up to nothing.

#include <catch2/catch.hpp>
#include <random>

#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/viscoelastic.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// A jagged jet of unequal beads whose youngest one is 1.8 elements from the circling nozzle.
Jet<3> jagged(int n) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> aside(-0.5, 0.5), some(0.5, 2);
  std::vector<Bead<3>> beads;
  for (int i = n; i >= 1; --i) {
    const Vec<3> r(1.75 * i, i == 1 ? 0.3 : aside(random), i == 1 ? 0.1 : aside(random));
    beads.push_back(
        {r, Vec<3>(aside(random), aside(random), 0), some(random) - 1, some(random), some(random)});
  }
  return jet_of<3>(beads);
}

/// Force of the beads on a charge at r.
Vec<3> coulomb_on(const Vec<3>& r, double q, const Jet<3>& jet, double Q) {
  Vec<3> force = Vec<3>::Zero();
  for (Eigen::Index i = 0; i < jet.size(); ++i) {
    const Vec<3> d = r - position<3>(jet.y, i);
    force += Q * q * jet.charge[i] * d / std::pow(d.norm(), 3);
  }
  return force;
}

}  // namespace

TEST_CASE("The internal forces on beads, held bead and nozzle sum up to zero") {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.perturb = true;
  p.perturb_frequency = 3;
  p.perturb_amplitude = 0.05;
  const Nozzle<3> nozzle(p);
  const double Q = 2.5, L_step = 1.2, F_ve = 3;
  for (bool held : {false, true}) {
    CAPTURE(held);
    Jet<3> jet = jagged(40);
    jet.t = 0.7;
    jet.held = held;
    auto f = equations<3>(p, Viscoelastic<3>(L_step, F_ve), CoulombForce<3>(Q, 1 << 30));
    const State<3> dy = slope(f, jet);

    const Vec<3> youngest = position<3>(jet.y, 39), at = nozzle.position(jet.t);
    Vec<3> on_boundary = coulomb_on(at, 1, jet, Q);
    if (held) {
      const auto [p_held, q_held, no_mass] = nozzle.held(jet, youngest, jet.t);
      CHECK(no_mass == 0);
      on_boundary += coulomb_on(p_held, q_held, jet, Q);
    }
    on_boundary +=
        L_step * F_ve * jet.y(39, stress_column<3>) * (youngest - at) / (youngest - at).squaredNorm();

    Vec<3> on_beads = Vec<3>::Zero();
    double size = 0;
    for (Eigen::Index i = 0; i < jet.size(); ++i) {
      on_beads += jet.mass[i] * velocity<3>(dy, i);
      size += jet.mass[i] * velocity<3>(dy, i).norm();
    }
    REQUIRE(on_boundary.norm() > 0.1);                      // the reaction is not left out by accident
    CHECK((on_beads + on_boundary).norm() < 1e-14 * size);  // 1600 pairs of random round-off
  }
}

TEST_CASE("An element pulls its two ends with the tension of its section: it thins as it lengthens") {
  const Parameters p = plain_parameters();
  const double L_step = 1.2, F_ve = 3, stress = 0.8;
  auto f = equations<1>(p, Viscoelastic<1>(L_step, F_ve));
  for (double l : {0.5, 1.0, 4.0, 1e6}) {
    const auto dy = slope(f, jet_of<1>({bead_at(2 + l, 0, stress), bead_at(2, 0, 0)}));
    // pi a^2 = pi a_0^2 L_step / l by the element's volume, so force times length is the same at any length
    CHECK(-dy(0, 1) * l == Approx(L_step * F_ve * stress).epsilon(1e-14 * (2 + l) / l));
    CHECK(dy(1, 1) == -dy(0, 1));
  }
}
