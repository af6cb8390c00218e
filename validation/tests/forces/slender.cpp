/// The self-field of a slender tube and the energy of its surface: closed answers, energy, momentum,
/// derivative.

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "forces/terms/surface_energy.hpp"
#include "forces/terms/wide_logarithm.hpp"
#include "validation/support/charged_thread.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;
using std::numbers::pi;

namespace {

constexpr int all_pairs = 1 << 30;

/// A nozzle on a circle of this radius around the x axis, at rest, at y = radius.
Parameters nozzle_at(double radius) {
  Parameters p = plain_parameters();
  p.perturb = true;
  p.perturb_amplitude = radius;
  return p;
}

/// N charges on a circle of radius 1 around the x axis, the nozzle one of them: the force on the one
/// opposite, away from the centre.
template <class... Terms>
double push_on_ring(int N, Terms... terms) {
  std::vector<Bead<3>> beads;
  for (int i = N - 1; i >= 1; --i)
    beads.push_back({Vec<3>(0, std::cos(2 * pi * i / N), std::sin(2 * pi * i / N))});
  auto f = equations<3>(nozzle_at(1), std::move(terms)...);
  return -slope(f, jet_of<3>(beads))(N / 2 - 1, 4);
}

/// A crooked jet of unequal beads. Elements are from a third of `length` to some of them long.
template <int D>
Jet<D> crooked(int n, double length) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> between(-0.3, 0.3);
  std::vector<Bead<D>> beads;
  for (int i = n; i >= 1; --i) {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = length * between(random);
    r[0] += length * i;
    beads.push_back({r, Vec<D>::Zero(), 0, 1 + between(random), 1 + between(random)});
    beads.back().volume = 1 + between(random);
  }
  return jet_of<D>(beads);
}

/// The largest difference between a term's force and the slope of its energy, over the largest force.
template <int D, class Term>
double off_energy(const Term& term, const Jet<D>& jet) {
  const Parameters p = plain_parameters();
  auto f = equations<D>(p, term);
  const auto energy_at = [&](const State<D>& y) {
    State<D> dy;
    f(jet, 0, y, dy);
    return term.energy(f.chain());
  };
  const State<D> dy = slope(f, jet);
  const double step = 1e-5 * std::abs(jet.y(jet.size() - 1, 0));
  double worst = 0, largest = 0;
  for (Eigen::Index i = 0; i < jet.size(); ++i)
    for (int k = 0; k < D; ++k) {
      State<D> more = jet.y, less = jet.y;
      more(i, k) += step, less(i, k) -= step;
      const double force = jet.mass[i] * dy(i, velocity_column<D> + k);
      worst = std::max(worst, std::abs(force + (energy_at(more) - energy_at(less)) / (2 * step)));
      largest = std::max(largest, std::abs(force));
    }
  return worst / largest;
}

/// The largest difference between the derivative of the acceleration by positions, from J, and by
/// differences, over the largest entry.
template <int D>
double off_derivative(EquationsOfMotion<D>& f, const Jet<D>& jet) {
  const Eigen::Index n = jet.size();
  LocalJacobian<D> J;
  f.differentiate(jet, jet.t, jet.y, J);
  const double step = 1e-6 * std::abs(jet.y(n - 1, 0));
  double worst = 0, largest = 0;
  for (Eigen::Index j = 0; j < n; ++j)
    for (int k = 0; k < D; ++k) {
      State<D> more = jet.y, less = jet.y, up, down;
      more(j, k) += step, less(j, k) -= step;
      f(jet, jet.t, more, up);
      f(jet, jet.t, less, down);
      for (Eigen::Index i = 0; i < n; ++i) {
        Vec<D> expected = Vec<D>::Zero();
        const auto column = [&](Eigen::Index e) -> Vec<D> {
          return J.element[std::size_t(e)].tension_by_d.col(k);
        };
        if (i == j) expected -= column(i);
        if (i == j && i > 0) expected -= column(i - 1);
        if (i + 1 == j) expected += column(i);
        if (i == j + 1) expected += column(i - 1);
        expected *= J.inverse_mass[i];
        const Vec<D> found = (velocity<D>(up, i) - velocity<D>(down, i)) / (2 * step);
        worst = std::max(worst, (found - expected).cwiseAbs().maxCoeff());
        largest = std::max(largest, expected.cwiseAbs().maxCoeff());
      }
    }
  return worst / largest;
}

/// The chain of a helical thread, growing in pitch and radius, with half a bead at the end that is free and
/// the nozzle far away: forces on the inner beads over their masses. N is a multiple of 16.
State<3> push_on_helix(int N, double radius, bool slender) {
  std::vector<Bead<3>> beads;
  const double l = 4.0 / N;
  for (int i = 0; i <= N; ++i) {
    const double s = 4.0 * i / N, R = 0.1 + 0.05 * s, turn = 2 * pi * s;
    const bool end = i == 0 || i == N;
    const double cell = end ? 0.5 : 1;
    beads.push_back({Vec<3>(100 + s + 0.1 * s * s, R * std::cos(turn), R * std::sin(turn)), Vec<3>::Zero(), 0,
                     l * cell, l * cell});
  }
  // charge over mass is 1 and an element's volume, hence its charge, that of one bead: both scale with l
  auto f = slender ? equations<3>(plain_parameters(), CoulombForce<3>(1, all_pairs),
                                  SlenderSelfField<3>(l * l, Section{radius, l}))
                   : equations<3>(plain_parameters(), CoulombForce<3>(1, all_pairs));
  return slope(f, jet_of<3>(beads));
}

}  // namespace

TEST_CASE("The wide logarithm and exponential are those of the library to a few last places") {
  for (double x = 1e-300; x < 1e300; x *= 1.37)
    CHECK(wide_log(x) == Approx(std::log(x)).epsilon(4e-16).margin(4e-16));
  for (double x = 0; x > -700; x -= 0.173) CHECK(wide_exp(x) == Approx(std::exp(x)).epsilon(1e-15));
}

TEST_CASE("A charged ring of a thin tube is pushed apart by lambda^2 / rho (ln(8 rho / a) - 3/2) a length") {
  const double a = 1e-2;
  const int N = 64;
  const double l = 2 * std::sin(pi / N), arc = 2 * pi / N, lambda = 1 / arc;
  const double expected = lambda * lambda * (std::log(8 / a) - 1.5) * arc;
  const double found = push_on_ring(N, CoulombForce<3>(1, all_pairs), SlenderSelfField<3>(1, Section{a, l}));
  CHECK(found == Approx(expected).epsilon(1e-4));  // 3e-5 measured; the error is third order in 1 / N
  // point charges alone push the more the more they are, by a logarithm; the next term is (pi / N)^2 / 36
  const auto of_points = [](int n) { return push_on_ring(n, CoulombForce<3>(1, all_pairs)) * 2 * pi / n; };
  CHECK(of_points(2 * N) - of_points(N) == Approx(std::log(2)).margin(1e-3));
}

TEST_CASE("On a helix of growing pitch and radius the slender self-field converges, point charges do not") {
  const auto error = [](int N, const State<3>& finest, int finest_N, bool slender) {
    const State<3> coarse = push_on_helix(N, 1e-3, slender);
    double square = 0, size = 0;
    for (int i = N / 8; i <= N - N / 8; ++i) {
      const Vec<3> reference = velocity<3>(finest, Eigen::Index(i) * (finest_N / N));
      square += (velocity<3>(coarse, i) - reference).squaredNorm();
      size += reference.squaredNorm();
    }
    return std::sqrt(square / size);
  };
  const State<3> finest = push_on_helix(1024, 1e-3, true);
  std::vector<double> of_slender, of_points;
  for (int N : {16, 32, 64, 128}) {
    of_slender.push_back(error(N, finest, 1024, true));
    of_points.push_back(error(N, finest, 1024, false));
  }
  CAPTURE(of_slender, of_points);
  for (double order : orders(of_slender)) CHECK(order > 2);
  CHECK(of_points.back() > 0.2);
}

TEST_CASE("Self-field and surface tension follow from their energies, from a third of the radius on") {
  const double central =
      1e-8;  // differences: step^2 1e-10 times the curvature, some 10, and round-off over step
  for (double a : {3.0, 1.0, 0.3, 1e-3}) {
    CAPTURE(a);
    CHECK(off_energy<3>(SlenderSelfField<3>(2, Section{a, 1}), crooked<3>(12, 1)) < central);
    CHECK(off_energy<3>(SurfaceEnergy<3>(0.7, Section{a, 1}), crooked<3>(12, 1)) < central);
    CHECK(off_energy<1>(SlenderSelfField<1>(2, Section{a, 1}), crooked<1>(12, 1)) < central);
    CHECK(off_energy<3>(SlenderSelfField<3>(2, Section{a, 1}, /*uneven*/ true), crooked<3>(12, 1)) < central);
    CHECK(off_energy<1>(SurfaceEnergy<1>(0.7, Section{a, 1}), crooked<1>(12, 1)) < central);
  }
}

TEST_CASE("Within the jet the slender self-field and the surface push nothing away") {
  const Jet<3> jet = crooked<3>(300, 1);
  for (double a : {1.0, 1e-2}) {
    auto f = equations<3>(plain_parameters(), SlenderSelfField<3>(2, Section{a, 1}),
                          SurfaceEnergy<3>(0.7, Section{a, 1}));
    const State<3> dy = slope(f, jet);
    Vec<3> sum = Vec<3>::Zero();
    double size = 0;
    for (Eigen::Index i = 0; i < jet.size(); ++i) {
      sum += jet.mass[i] * velocity<3>(dy, i);
      size += jet.mass[i] * velocity<3>(dy, i).norm();
    }
    // what is left is the nozzle's pull, along the youngest element
    const Vec<3> t = position<3>(jet.y, jet.size() - 1).normalized();
    CHECK((sum - sum.dot(t) * t).norm() < 1e-14 * size);
    CHECK(std::abs(sum.dot(t)) > 1e-4);
  }
}

TEST_CASE("The derivative of self-field and surface tension is exact, limiter and held bead included") {
  for (bool held : {false, true})
    for (double a : {1.0, 0.3, 1e-3}) {
      CAPTURE(held, a);
      Parameters p = plain_parameters();
      p.inserting = true;
      auto jet = crooked<3>(8, 1);
      jet.y.col(0) += 0.75;  // the youngest bead between place and release
      jet.held = held;
      auto f = equations<3>(p, SlenderSelfField<3>(2, Section{a, 1}), SurfaceEnergy<3>(0.7, Section{a, 1}));
      // differences: step^2 of 1e-12 and round-off of 1e-16 over the step
      CHECK(off_derivative<3>(f, jet) < 1e-7);
      auto uneven = equations<3>(p, SlenderSelfField<3>(2, Section{a, 1}, /*uneven*/ true));
      slope(uneven, jet);
      CHECK(off_derivative<3>(uneven, jet) < 1e-7);
      auto straight = crooked<1>(8, 1);
      straight.y.col(0) += 0.75;
      straight.held = held;
      auto g = equations<1>(p, SlenderSelfField<1>(2, Section{a, 1}), SurfaceEnergy<1>(0.7, Section{a, 1}));
      CHECK(off_derivative<1>(g, straight) < 1e-7);
    }
}

TEST_CASE("While a bead is held the tension goes over from the element without it to the one with it") {
  const Parameters p = plain_parameters();
  const Nozzle<1> nozzle(p);
  const auto force = [&](double d, bool held) {
    auto f = equations<1>(p, SlenderSelfField<1>(2, Section{1e-2, 1}));
    auto jet = jet_of<1>({bead_at(d)});
    jet.held = held;
    return slope(f, jet)(0, 1);
  };
  CHECK(force(1.5, true) == Approx(force(1.5, false)).epsilon(1e-14));  // placed without charge
  auto released = equations<1>(p, SlenderSelfField<1>(2, Section{1e-2, 1}));
  const auto two = slope(released, jet_of<1>({bead_at(2), bead_at(1)}));
  CHECK(force(2, true) == Approx(two(0, 1)).epsilon(1e-14));  // released with all of it
}

TEST_CASE("A ring of surface tension pulls inwards by pi a alpha over its radius a length") {
  const double a = 1e-2, alpha = 0.7;
  const int N = 64;
  const double l = 2 * std::sin(pi / N);
  // each of the two elements pulls with cos of the turn's half: exact on the polygon
  const double expected = -pi * a * alpha * 2 * std::sin(pi / N);
  CHECK(push_on_ring(N, SurfaceEnergy<3>(alpha, Section{a, l})) == Approx(expected).epsilon(1e-12));
}

TEST_CASE("A slender jet is the same at one rate and at two, and with its local terms solved for") {
  const auto radius_and_place = [](Scheme scheme, Multirate multirate) {
    Parameters p = example("pvp", {"self field slender", "surface tension model energy"});
    p.tolerance = 1e-8;
    p.integrator = scheme;
    p.multirate = multirate;
    Run<3> run(p);
    run.to(4.5e-3);
    return State<3>(run.jet().y);
  };
  const auto one = radius_and_place(Scheme::verner6, Multirate::no);
  // tolerance 1e-8 times some 100 events, against beads up to 100 away: 1e-6 at the most
  for (const auto& other : {radius_and_place(Scheme::verner6, Multirate::automatic),
                            radius_and_place(Scheme::kencarp5, Multirate::no)}) {
    REQUIRE(other.rows() == one.rows());
    CHECK((other - one).leftCols<3>().abs().maxCoeff() < 1e-6 * one.leftCols<3>().abs().maxCoeff());
  }
}

TEST_CASE("A helical wave on a straight thread grows as slender-body theory says, with 100 elements") {
  const ChargedThread thread;
  CHECK(thread.theory() == Approx(15831).epsilon(1e-3));
  CHECK(thread.growth(100, true) ==
        Approx(thread.theory()).epsilon(5e-3));  // second order in k l, which is 0.5
  // points: theory's logarithm ends at the spacing instead of the radius
  for (int N : {100, 200}) CHECK(thread.growth(N, false) == Approx(thread.theory_of_points(N)).epsilon(2e-2));
}

TEST_CASE("The endless helix grows as linear theory says while it is flat") {
  const ChargedThread thread;
  const double bracket = std::log(2 / (thread.k() * thread.radius)) - std::numbers::egamma;
  constexpr double flat = 1e-5;  // its square is what is left out
  CHECK(thread.push_on_helix(flat) / flat == Approx(bracket).epsilon(1e-7));
}

TEST_CASE("A large helical wave on a long thread grows as an endless helix does, of points without a limit") {
  const LargeWave wave;
  const double helix = wave.thread.amplification_of_helix(wave.amplitude, wave.seconds);
  std::vector<double> slender, points;
  for (const int elements : {200, 400}) {
    const auto grown = [&](bool tubes) {
      return wave.thread.amplification(elements, tubes, wave.amplitude, wave.seconds, wave.part);
    };
    slender.push_back(grown(true));
    points.push_back(grown(false));
  }
  // chords are (k l)^2 / 24 shorter than their arcs, 0.3 % at k l = 1/4, four times as much at twice that;
  // the ends of 16 waves leave 1e-3
  CHECK(slender[0] == Approx(helix).epsilon(1.3e-2));
  CHECK(slender[1] == Approx(helix).epsilon(4e-3));
  // the spacing ends the logarithm: of small waves cosh 2.37 = 5.4 and cosh 2.72 = 7.6, of tubes 10.4
  CHECK(points[1] < 0.8 * helix);
  CHECK(points[1] > 1.3 * points[0]);
}

TEST_CASE("A small helical wave on a long thread grows as the hyperbolic cosine of linear theory") {
  const LargeWave wave;
  const double grown = wave.thread.amplification(400, true, wave.small, wave.seconds, wave.part);
  // as above; the growth rate enters 3 times over
  CHECK(grown == Approx(std::cosh(wave.thread.theory() * wave.seconds)).epsilon(4e-3));
}
