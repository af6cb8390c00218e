/// Stiff chains: the local Jacobian, the additive pair and the choice of it.

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "core/jet/stiffness.hpp"
#include "core/jet/viscous_stress.hpp"
#include "forces/terms/laws/elastoviscoplastic.hpp"
#include "forces/terms/laws/fene_p.hpp"
#include "forces/terms/laws/giesekus.hpp"
#include "forces/terms/laws/inelastic.hpp"
#include "forces/terms/laws/kelvin_voigt.hpp"
#include "forces/terms/laws/oldroyd_b.hpp"
#include "forces/terms/surface_tension.hpp"
#include "forces/terms/viscoelastic.hpp"
#include "forces/terms/viscous_tension.hpp"
#include "integrators/schemes/additive.hpp"
#include "integrators/schemes/chain_solver.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// Beads down a crooked line, stretching and shearing, under stress; masses differ.
template <int D>
Jet<D> crooked_jet(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> between(-0.3, 0.3);
  std::vector<Bead<D>> beads;
  for (int i = 0; i < n; ++i) {
    Vec<D> r, v;
    for (int k = 0; k < D; ++k) r[k] = between(random), v[k] = between(random);
    r[0] += 1.2 * (n - i);
    v[0] += 0.8 * (n - i);
    beads.push_back({r, v, 2 + 5 * between(random), 1 + between(random), 1});
  }
  return jet_of<D>(beads);
}

Parameters circling_nozzle() {
  Parameters p = plain_parameters();
  p.perturb = true;
  p.perturb_frequency = 2;
  p.perturb_amplitude = 0.1;
  p.nozzle_velocity = 0.3;
  return p;
}

template <int D>
Eigen::VectorXd flat(const State<D>& y) {
  return Eigen::Map<const Eigen::VectorXd>(y.data(), y.size());
}

/// The derivative of the slope by central differences, columns and rows in the order of `flat`.
template <int D>
Eigen::MatrixXd by_differences(RightHandSide<D>& f, const Jet<D>& jet) {
  constexpr double step = 1e-5;  // truncation step^2 and round-off 1e-16 / step are both about 1e-10
  Eigen::MatrixXd J(jet.y.size(), jet.y.size());
  State<D> low, high;
  for (Eigen::Index k = 0; k < jet.y.size(); ++k) {
    State<D> y = jet.y;
    y.data()[k] += step;
    f(jet, 0.4, y, high);
    y.data()[k] -= 2 * step;
    f(jet, 0.4, y, low);
    J.col(k) = flat<D>(high - low) / (2 * step);
  }
  return J;
}

/// The local Jacobian as a dense matrix, through the solver: 1 - s J from its inverse's columns.
template <int D>
Eigen::MatrixXd as_solved(RightHandSide<D>& f, const Jet<D>& jet, double s) {
  LocalJacobian<D> J;
  f.differentiate(jet, 0.4, jet.y, J);
  ChainSolver<D> solver;
  solver.factor(J, s);
  const Eigen::Index m = jet.y.size();
  Eigen::MatrixXd inverse(m, m);
  for (Eigen::Index k = 0; k < m; ++k) {
    State<D> unit = State<D>::Zero(jet.size(), jet.y.cols());
    unit.data()[k] = 1;
    solver.solve(unit);
    inverse.col(k) = flat<D>(unit);
  }
  return (Eigen::MatrixXd::Identity(m, m) - inverse.inverse()) / s;
}

template <int D>
void check_jacobian(std::unique_ptr<StressLaw<D>> law) {
  std::vector<std::unique_ptr<ForceTerm<D>>> terms;
  terms.push_back(std::make_unique<Viscoelastic<D>>(1, 3));
  terms.push_back(std::make_unique<ViscousTension<D>>(1, 3, ViscousStress{0.8, 0.6, 0.05}));
  const auto columns = static_cast<Eigen::Index>(law->columns().size());
  EquationsOfMotion<D> f(Nozzle<D>(circling_nozzle()), std::move(law), std::move(terms), nullptr, Threads{1});
  for (int n : {1, 2, 7}) {
    for (bool held : {false, true}) {
      Jet<D> jet = crooked_jet<D>(n, 3);
      jet.y.conservativeResize(Eigen::NoChange, own_columns<D> + columns);
      for (Eigen::Index k = 0; k < columns; ++k) jet.y.col(own_columns<D> + k).setLinSpaced(-0.6, 0.4);
      jet.held = held;
      const Eigen::MatrixXd J = by_differences<D>(f, jet);
      CAPTURE(D, n, held);
      // the differences' error 1e-9, and the inverse's, whose condition is below 1e3
      CHECK((as_solved<D>(f, jet, 0.1) - J).cwiseAbs().maxCoeff() < 1e-8 * J.cwiseAbs().maxCoeff());
    }
  }
}

/// PVP case with modulus and viscosity multiplied.
Parameters pvp(double modulus, double viscosity, double tolerance, Scheme scheme = Scheme::automatic) {
  Parameters p = with_tolerance(example("pvp"), tolerance, scheme);
  p.elastic_modulus *= modulus;
  p.viscosity *= viscosity;
  return p;
}

}  // namespace

TEST_CASE("The local Jacobian of Maxwell chains is the derivative of their slope") {
  check_jacobian<1>(std::make_unique<Maxwell<1>>());
  check_jacobian<3>(std::make_unique<Maxwell<3>>());
}

TEST_CASE("The local Jacobian of Herschel-Bulkley chains is the derivative of their slope") {
  check_jacobian<1>(std::make_unique<HerschelBulkley<1>>(0.2, 1.3, 0.7, 0.1));
  check_jacobian<3>(std::make_unique<HerschelBulkley<3>>(0.2, 1.3, 1.6, 0.1));
}

TEST_CASE("The local Jacobian of a chain under any other stress law is the derivative of its slope") {
  const auto check = []<class Law>(const Law& law) {
    check_jacobian<1>(std::make_unique<ElementLaw<1, Law>>(law));
    check_jacobian<3>(std::make_unique<ElementLaw<3, Law>>(law));
  };
  check(KelvinVoigt());
  check(Inelastic());
  check(OldroydB());
  check(Giesekus{0.3});
  check(FeneP::of_length(5));
  check(Elastoviscoplastic{0.2, 1.3, 0.7});
}

TEST_CASE("The additive tableaux share abscissae and weights, and meet the conditions of order 5 and 4") {
  using T = KennedyCarpenter5;
  Eigen::Matrix<double, 8, 8> part[2];
  Eigen::Matrix<double, 8, 1> b[2], c;
  for (int i = 0; i < 8; ++i) {
    b[0][i] = T::b[i];
    b[1][i] = T::partner[i];
    c[i] = T::c[i];
    for (int j = 0; j < 8; ++j) {
      part[0](i, j) = T::explicit_part[i][j];
      part[1](i, j) = T::implicit_part[i][j];
    }
  }
  const double digits = 1e-14;  // the coefficients have 16
  for (const auto& A : part) CHECK((A.rowwise().sum() - c).cwiseAbs().maxCoeff() < digits);
  CHECK((part[1].row(7).transpose() - b[0]).cwiseAbs().maxCoeff() < digits);

  const auto power = [&](int k) { return Eigen::Matrix<double, 8, 1>(c.array().pow(k)); };
  for (int k = 0; k < 5; ++k) {
    CHECK(b[0].dot(power(k)) == Approx(1. / (k + 1)).epsilon(digits));
    if (k < 4) CHECK(b[1].dot(power(k)) == Approx(1. / (k + 1)).epsilon(digits));
  }
  const auto times_c = [&](const Eigen::Matrix<double, 8, 1>& u) {
    return Eigen::Matrix<double, 8, 1>(u.array() * c.array());
  };
  const double loose = 1e-13;  // sums of products of up to five coefficients of size 1
  for (const auto& A : part) {
    for (int partner : {0, 1}) {
      CAPTURE(partner);
      CHECK(b[partner].dot(A * c) == Approx(1. / 6).epsilon(loose));
      CHECK(b[partner].dot(times_c(A * c)) == Approx(1. / 8).epsilon(loose));
      CHECK(b[partner].dot(A * power(2)) == Approx(1. / 12).epsilon(loose));
      for (const auto& B : part) CHECK(b[partner].dot(A * B * c) == Approx(1. / 24).epsilon(loose));
    }
    CHECK(b[0].dot(times_c(times_c(A * c))) == Approx(1. / 10).epsilon(loose));
    CHECK(b[0].dot(times_c(A * power(2))) == Approx(1. / 15).epsilon(loose));
    CHECK(b[0].dot(A * power(3)) == Approx(1. / 20).epsilon(loose));
    for (const auto& B : part) {
      CHECK((A * c).cwiseProduct(B * c).dot(b[0]) == Approx(1. / 20).epsilon(loose));
      CHECK(b[0].dot(times_c(A * B * c)) == Approx(1. / 30).epsilon(loose));
      CHECK(b[0].dot(A * times_c(B * c)) == Approx(1. / 40).epsilon(loose));
      CHECK(b[0].dot(A * B * power(2)) == Approx(1. / 60).epsilon(loose));
      for (const auto& C : part) CHECK(b[0].dot(A * B * C * c) == Approx(1. / 120).epsilon(loose));
    }
  }
}

TEST_CASE("The step of the additive pair is not bound by the relaxation time, that of an explicit pair is") {
  // Relaxation time 0.13 us, a bead in about 120 us: stability binds Verner's pair to some 200 steps a bead.
  Run<3> explicit_run(pvp(3000, 1, 1e-3, Scheme::verner6)),
      additive_run(pvp(3000, 1, 1e-3, Scheme::kencarp5));
  const Effort by_explicit = explicit_run.to(2e-3), by_additive = additive_run.to(2e-3);
  CHECK(by_explicit.placed == by_additive.placed);
  CHECK(by_explicit.steps > 5 * by_additive.steps);
  // a hundredth of what a step may have at this tolerance
  CHECK(additive_run.x() == Approx(explicit_run.x()).epsilon(1e-3));
}

TEST_CASE("The additive pair follows its tolerance in a stiff scene") {
  const double t = 1e-3;  // some 8 beads
  Run<3> reference(pvp(1000, 1, 1e-11, Scheme::verner6));
  reference.to(t);
  double before = 1;
  for (double tolerance : {1e-4, 1e-6, 1e-8}) {
    Run<3> run(pvp(1000, 1, tolerance, Scheme::kencarp5));
    run.to(t);
    const double error = std::abs(run.x() - reference.x());
    CAPTURE(tolerance, error, before);
    // a hundredth of the tolerance buys at least a third of the error, and stays below 1000 times it
    CHECK(error < before / 3);
    CHECK(error < 1000 * tolerance);
    before = error;
  }
}

TEST_CASE("Auto takes the additive pair for stiff scenes only, and says why") {
  const Parameters stiff = pvp(1000, 1, 1e-6), plain = pvp(1, 1, 1e-6), slow = pvp(1, 1000, 1e-6);
  CHECK(chosen_scheme(stiff) == Scheme::kencarp5);
  CHECK(chosen_scheme(pvp(1000, 1000, 1e-6)) == Scheme::kencarp5);
  CHECK(chosen_scheme(plain) == Scheme::verner6);
  CHECK(chosen_scheme(slow) == Scheme::verner6);
  CHECK(chosen_scheme(pvp(1000, 1, 1e-6, Scheme::dopri5)) == Scheme::dopri5);
  CHECK_THAT(steps_description(stiff), Catch::Contains("stiff"));
  CHECK_THAT(steps_description(plain), Catch::Contains("not stiff"));
}

TEST_CASE("Two rates are left out of scenes that are solved for, or whose stress relaxes between two beads") {
  const auto multirate = [](double modulus) {
    Parameters p = pvp(modulus, 1, 1e-6);
    p.multirate = Multirate::automatic;
    return compose<3>(p, {1}).multirate != nullptr;
  };
  CHECK(multirate(1));
  CHECK_FALSE(multirate(20));    // Verner's pair, but interval / tau = 6.5
  CHECK_FALSE(multirate(1000));  // the additive pair
}

TEST_CASE("Two rates are left out where the stress law has a kink, and say so") {
  Parameters p = pvp(1, 1, 1e-6);
  p.multirate = Multirate::automatic;
  p.stress_law = StressLawKind::oldroyd_b;
  CHECK(compose<3>(p, {1}).multirate != nullptr);
  p.stress_law = StressLawKind::herschel_bulkley;
  p.yield_stress = 1000;
  const Scene<3> scene = compose<3>(p, {1});
  CHECK(scene.multirate == nullptr);
  CHECK(std::any_of(scene.left_out.begin(), scene.left_out.end(), [](const Composed& c) {
    return c.term == "two rates" && c.reason.find("kink") != std::string::npos;
  }));
}

TEST_CASE("The estimate of the fastest rate: relaxation in viscous chains, waves in elastic ones") {
  // tau = 0.4 us: 1 / tau, less the share of the viscous mode; tau = 0.4 ms: omega = 2 / l sqrt(G / rho)
  CHECK(stiffness(pvp(1000, 1, 1e-6)).fastest_rate == Approx(2.5e6).epsilon(0.15));
  CHECK(stiffness(pvp(1000, 1000, 1e-6)).fastest_rate ==
        Approx(100 * std::sqrt(5e7 / 0.839253525)).epsilon(1e-9));
}

TEST_CASE("The additive pair is taken from twenty steps a bead on, an explicit one below") {
  // the modulus at which an explicit scheme needs so many steps from bead to bead, by bisection
  const auto modulus_for = [](double steps) {
    double low = 1, high = 1e4;
    for (int k = 0; k < 60; ++k) {
      const double middle = std::sqrt(low * high);
      (stiffness(pvp(middle, 1, 1e-6)).stable_steps() < steps ? low : high) = middle;
    }
    return high;
  };
  CHECK(chosen_scheme(pvp(modulus_for(19), 1, 1e-6)) == Scheme::verner6);
  CHECK(chosen_scheme(pvp(modulus_for(21), 1, 1e-6)) == Scheme::kencarp5);
}

TEST_CASE("Stress or drag relaxes between beads if its time is less than half their interval") {
  CHECK_FALSE(Stiffness{1, 1, 1.9, 0}.relaxes_between_beads());
  CHECK(Stiffness{1, 1, 2.1, 0}.relaxes_between_beads());
  CHECK_FALSE(Stiffness{1, 1, 1, 1.9}.relaxes_between_beads());
  CHECK(Stiffness{1, 1, 1, 2.1}.relaxes_between_beads());
}

TEST_CASE("An overdamped element relaxes by the quadratic formula, and a tube's own field stiffens it") {
  Parameters p = pvp(1000, 1, 1e-6);
  const Scales s = scales(p);
  const double omega = 2 / s.l_step * std::sqrt(p.elastic_modulus / p.density_mass), damping = 1 / s.time;
  REQUIRE(damping > 2 * omega);
  CHECK(stiffness(p).fastest_rate ==
        Approx((damping + std::sqrt(damping * damping - 4 * omega * omega)) / 2).epsilon(1e-12));
  p = pvp(1000, 1000, 1e-6);
  p.self_field = SelfField::slender;
  const double g = std::log(2 * s.l_step / p.nozzle_cross) - std::numbers::egamma;
  const double self = s.charge * s.charge / std::pow(s.l_step, 3) * (2 * std::abs(g) + 4.5);
  const double wave = 4 / (s.l_step * s.l_step) * p.elastic_modulus / p.density_mass;
  CHECK(stiffness(p).fastest_rate == Approx(std::sqrt(wave + 4 * self / s.mass)).epsilon(1e-12));
}

TEST_CASE("A run shorter than the interval of beads has no other to relax within") {
  Parameters p = pvp(1, 1, 1e-6);
  const double interval = stiffness(p).bead_interval;
  p.final_time = interval / 3;
  CHECK(stiffness(p).bead_interval == p.final_time);
}

TEST_CASE("The viscous stress of a power law and its slope are closed formulae, its consistency is scaled") {
  const ViscousStress thinning{.consistency = 2, .index = 0.5};
  CHECK(thinning(4) == Approx(2 * 2).epsilon(1e-14));  // K r^n
  CHECK(thinning.derivative(4) == Approx(2 * 0.5 / 2).epsilon(1e-14));
  Parameters p = pvp(1, 1, 1e-6);
  p.hb_index = 0.8;
  p.hb_consistency = 3;
  CHECK(scaled_consistency(p) == Approx(3 * std::pow(p.viscosity / p.elastic_modulus, 0.2)).epsilon(1e-14));
  p.solvent_viscosity = p.viscosity / 4;
  CHECK(viscous_stress(p).consistency == 0.25);
}

TEST_CASE("The implicit solve of a bead under drag alone is that of a single linear equation") {
  LocalJacobian<1> J;
  J.element.resize(1);
  J.inverse_mass = Eigen::ArrayXd::Ones(1);
  J.by_velocity()[0](0, 0) = -3;
  ChainSolver<1> solver;
  const double s = 0.5;
  solver.factor(J, s);
  State<1> u = State<1>::Zero(1, own_columns<1>);
  u(0, velocity_column<1>) = 1;
  solver.solve(u);
  CHECK(u(0, velocity_column<1>) == Approx(1 / (1 + 3 * s)).epsilon(1e-15));
  CHECK(u(0, 0) == Approx(s / (1 + 3 * s)).epsilon(1e-15));
}
