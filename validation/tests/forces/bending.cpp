/// The moment of a bent thread: forces, torques and rate against closed answers, beams and viscous threads
/// against theory.

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "forces/terms/bending.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

constexpr double radius = 0.1;

BendingMoment thread() {
  return BendingMoment(
      {.F_ve = 0.7, .section = {radius, 1}, .first = 0, .fresh_youngest = false, .mass_unit = 1});
}

EquationsOfMotion<3> bending_only(const BendingMoment& moment) {
  auto f = equations<3>(plain_parameters(), Bending(moment));
  for (int k = 0; k < 3; ++k) f.add_column(std::make_unique<BendingColumn>(moment, k));
  return f;
}

/// A crooked thread of unequal beads that moves at random, without moments.
Jet<3> crooked(int n) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> between(-0.3, 0.3);
  Jet<3> jet;
  jet.y = State<3>(0, own_columns<3> + 3);
  for (int i = n; i >= 1; --i) {
    const auto some = [&] { return Vec<3>(between(random), between(random), between(random)); };
    Bead<3> bead{Vec<3>(i, 0, 0) + some(), some(), 0, 1 + between(random), 1 + between(random)};
    bead.added = {0, 0, 0};
    append<3>(jet, bead);
    jet.volume[jet.size() - 1] = 1 + between(random);
  }
  return jet;
}

Chain<3> chain_of(EquationsOfMotion<3>& f, const Jet<3>& jet, const State<3>& y) {
  State<3> dy;
  f(jet, 0, y, dy);
  return f.chain();
}

/// Gives all beads the moments of a thread bent at once.
void bend_at_once(EquationsOfMotion<3>& f, const BendingMoment& moment, Jet<3>& jet) {
  const Chain<3> c = chain_of(f, jet, jet.y);
  for (int i = 0; i < c.beads; ++i) jet.y.row(i).tail<3>() = moment.elastic(c, i).transpose().array();
}

/// Sum of M . K of the moments in `jet` and the bends of y.
double work(const Jet<3>& jet, const State<3>& y) {
  double sum = 0;
  for (Eigen::Index i = 1; i < jet.size(); ++i) {
    const Vec<3> up = i + 1 < jet.size() ? position<3>(y, i + 1) : Vec<3>(Vec<3>::Zero());
    const Vec<3> K =
        (position<3>(y, i - 1) - position<3>(y, i)).normalized() - (position<3>(y, i) - up).normalized();
    sum += K.dot(Vec<3>(jet.y.row(i).tail<3>().transpose().matrix()));
  }
  return sum;
}

/// Velocity of a mode of frequency omega without relaxation, of 1 at first, after the time t.
double swing(double omega, double tau, double t) {
  using Complex = std::complex<double>;
  const Complex root = std::sqrt(Complex(1 / (4 * tau * tau) - omega * omega));
  const Complex s1 = -1 / (2 * tau) + root, s2 = -1 / (2 * tau) - root;
  return ((s1 * std::exp(s2 * t) - s2 * std::exp(s1 * t)) / (s1 - s2)).real();
}

/// A straight thread of length 1 from the nozzle, where it is hinged, to its free end, thrown sideways in the
/// shape of its first mode: the velocity of the end after the time t, over that at first. From some time on
/// all elements may be halved, but for the three next to the nozzle.
double velocity_of_end(int elements, double a, double tau, double t, double refined_from = -1) {
  Parameters p = plain_parameters();
  if (refined_from >= 0) {
    p.refinement = true;
    p.refinement_threshold = 0.9 / elements;
    p.refinement_every = p.refinement_start = refined_from;
  }
  p.system = 3;
  p.initial_length = 1;
  p.points = elements;
  p.nozzle_cross = a;
  p.viscosity = tau;
  p.bending = true;
  p.self_field = SelfField::slender;  // half a bead at the free end
  p.final_time = 1e9;
  p.tolerance = 1e-8;
  constexpr double kL = 3.926602312047919;  // tan kL = tanh kL
  Run<3> run(with_tolerance(p, 1e-8, Scheme::verner6));
  auto& y = run.scene.jet.y;
  constexpr double small = 1e-6;  // second order in it, tension is nothing
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    const double x = kL * y(i, 0) * run.unit.length;
    y(i, 4) = small * (std::sin(x) + std::sin(kL) / std::sinh(kL) * std::sinh(x));
  }
  const double thrown = y(0, 4);
  run.to(t);
  return run.jet().y(0, 4) / thrown;
}

}  // namespace

TEST_CASE("Moments do the work that bends ask for, and exert no net force", "[bending]") {
  const BendingMoment moment = thread();
  auto f = bending_only(moment);
  Jet<3> jet = crooked(9);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 1; i < jet.size(); ++i)
    for (int k = 0; k < 3; ++k) jet.y(i, own_columns<3> + k) = normal(random);
  const State<3> dy = slope(f, jet);
  const double h = 1e-5;
  for (Eigen::Index i = 0; i < jet.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      State<3> there = jet.y, back = jet.y;
      there(i, k) += h, back(i, k) -= h;
      const double expected = -(work(jet, there) - work(jet, back)) / (2 * h);
      // differences err by h^2 and by round-off over h
      CHECK(jet.mass[i] * dy(i, 3 + k) == Approx(expected).margin(1e-8));
    }
}

TEST_CASE("The torques of a thread bent at once, its support's included, sum to zero", "[bending]") {
  const BendingMoment moment = thread();
  auto f = bending_only(moment);
  Jet<3> jet = crooked(9);
  bend_at_once(f, moment, jet);
  const State<3> dy = slope(f, jet);
  Vec<3> torque = Vec<3>::Zero();  // about the nozzle, which bears the rest of the force
  double largest = 0;
  for (Eigen::Index i = 0; i < jet.size(); ++i) {
    const Vec<3> force = jet.mass[i] * velocity<3>(dy, i), arm = position<3>(jet.y, i);
    torque += arm.cross(force);
    largest = std::max(largest, arm.norm() * force.norm());
  }
  REQUIRE(largest > 1e-5);
  CHECK(torque.norm() < 1e-13 * largest);  // round-off
}

TEST_CASE("What is bent and stretched faster than it relaxes keeps the moments of a thread bent at once",
          "[bending]") {
  const BendingMoment moment = thread();
  auto f = bending_only(moment);
  Jet<3> jet = crooked(9);
  bend_at_once(f, moment, jet);
  const State<3> dy = slope(f, jet);
  const double h = 1e-5;
  State<3> later = jet.y, before = jet.y;
  // of the nozzle's velocity, zero here, nothing is to be known
  later.leftCols<3>() += h * jet.y.middleCols<3>(3), before.leftCols<3>() -= h * jet.y.middleCols<3>(3);
  const Chain<3> then = chain_of(f, jet, later), once = chain_of(f, jet, before);
  for (int i = 1; i < then.beads; ++i)
    for (int k = 0; k < 3; ++k) {
      const double expected = (moment.elastic(then, i)[k] - moment.elastic(once, i)[k]) / (2 * h);
      // relaxation left out, which is - M; differences err by h^2
      CHECK(dy(i, own_columns<3> + k) + jet.y(i, own_columns<3> + k) == Approx(expected).margin(1e-11));
    }
}

TEST_CASE("A bent thread that turns in its plane takes its moments along", "[bending]") {
  const BendingMoment moment = thread();
  auto f = bending_only(moment);
  Jet<3> jet = crooked(9);
  jet.y.col(2) = 0;
  const Vec<3> turn(0, 0, 1.3);
  for (Eigen::Index i = 0; i < jet.size(); ++i)
    jet.y.row(i).segment<3>(3) = turn.cross(position<3>(jet.y, i)).transpose().array();
  bend_at_once(f, moment, jet);
  jet.y.rightCols<3>() *= 0.4;  // of a thread that has relaxed
  const State<3> dy = slope(f, jet);
  for (Eigen::Index i = 1; i < jet.size(); ++i) {
    const Vec<3> M = jet.y.row(i).tail<3>().transpose().matrix(),
                 rate = dy.row(i).tail<3>().transpose().matrix();
    CHECK((rate + M - turn.cross(M)).norm() < 1e-14);  // round-off of terms of 1e-3
  }
}

TEST_CASE("A hinged beam swings, and a viscous thread comes to rest, as theory says: order 2", "[bending]") {
  constexpr double a = 0.02, k = 3.926602312047919;
  const double omega = a / 2 * k * k;  // of G = rho = 1
  struct Case {
    double tau, t;
  };
  const double slow = 0.2 / omega;  // all but Newtonian: mu pi a^4 / 4 times the rate of curvature
  for (const Case& c :
       {Case{1000 / omega, std::numbers::pi / (2 * omega)}, Case{slow, 1 / (omega * omega * slow)}}) {
    CAPTURE(c.tau);
    std::vector<double> errors;
    for (const int elements : {8, 16, 32})
      errors.push_back(std::abs(velocity_of_end(elements, a, c.tau, c.t) - swing(omega, c.tau, c.t)));
    const auto p = orders(errors);
    INFO(errors[0] << " " << errors[1] << " " << errors[2] << ", orders " << p[0] << " " << p[1]);
    // (k l)^2 / 12 of the frequency is 1.3e-3 at 32 elements, of the velocity after a quarter of the swing pi
    // / 2 times that; both ends, where waves are no sines, add terms of the same order
    CHECK(errors[2] < 1e-2);
    CHECK(p[1] > 1.8);
    CHECK(p[1] < 2.3);
  }
}

TEST_CASE("A split keeps the energy of a bend to second order, and a merge gives its moments back",
          "[bending]") {
  const BendingMoment moment = thread();
  auto f = bending_only(moment);
  const std::vector<Eigen::Index> moments = {own_columns<3>, own_columns<3> + 1, own_columns<3> + 2};
  std::vector<double> off, bent;
  for (const int n : {16, 32, 64}) {
    std::vector<Bead<3>> beads;
    for (int i = 0; i <= n; ++i) {
      const double s = 1.0 - double(i) / n, turn = s + s * s;  // a spiral
      beads.push_back({Vec<3>(5 + std::cos(turn), std::sin(turn), 0.3 * s)});
      beads.back().added = {0, 0, 0};
      beads.back().volume = 1.0 / n;
    }
    Jet<3> jet = jet_of<3>(beads);
    bend_at_once(f, moment, jet);
    const Jet<3> before = jet;
    std::vector<Eigen::Index> elements, added;
    for (Eigen::Index e = n / 4; e < 3 * n / 4; ++e) {
      elements.push_back(e);
      added.push_back(e + 1 + std::ssize(added));
    }
    split(jet, elements, moments);
    off.push_back(std::abs(work(jet, jet.y) / work(before, before.y) - 1));
    const Chain<3> c = chain_of(f, jet, jet.y);
    const int middle = 3 * n / 4 + 1;  // a new bead, half way along
    bent.push_back((moment.at(c, middle) - moment.elastic(c, middle)).norm() / moment.at(c, middle).norm());
    merge(jet, added, moments);
    CHECK((jet.y.rightCols<3>() == before.y.rightCols<3>()).all());
  }
  CAPTURE(off, bent);
  CHECK(off[2] < 1e-3);
  CHECK(orders(off)[1] > 1.8);
  CHECK(orders(bent)[1] > 1.8);
}

TEST_CASE("A thread that swings by its bending goes on, once its elements are halved, as one of finer ones",
          "[bending]") {
  constexpr double a = 0.02, k = 3.926602312047919, omega = a / 2 * k * k,
                   quarter = std::numbers::pi / (2 * omega);
  const double tau = 1000 / omega, t = 3 * quarter;  // the velocity passes 0: what it is tells the frequency
  const double coarse = velocity_of_end(12, a, tau, t), fine = velocity_of_end(24, a, tau, t),
               refined = velocity_of_end(12, a, tau, t, quarter);
  // two thirds of the way with finer elements, but for the three next to the nozzle
  CHECK(refined == Approx((coarse + 2 * fine) / 3).margin(std::abs(coarse - fine) / 5));
}

TEST_CASE("Case 3 with bending is the same at two rates as at one", "[bending]") {
  const std::vector<std::string> lines = {"bending yes", "collector distance 3", "final time 0.008"};
  const auto end_of = [&](const char* multirate, const char* tolerance) {
    auto all = lines;
    all.insert(all.end(), {multirate, tolerance});
    Run<3> run(example("pvp", all));
    run.to(0.008);
    return run;
  };
  const auto one = end_of("multirate no", "tolerance 1e-9"), two = end_of("multirate auto", "tolerance 1e-6");
  REQUIRE(one.scene.columns.size() == 3);
  REQUIRE(one.jet().size() == two.jet().size());
  const double apart =
      (one.jet().y.leftCols<3>() - two.jet().y.leftCols<3>()).abs().maxCoeff() * one.unit.length;
  CHECK(apart <
        16e-6 * 3);  // what the tolerance promises of the distance to the collector (docs/accuracy.md)
  CHECK(two.jet().y.rightCols<3>().abs().maxCoeff() > 0);
}

TEST_CASE("Bending is refused where its moment is not known, with the way out", "[bending]") {
  using Catch::Matchers::Contains;
  const auto refused = [](std::vector<std::string> lines, const char* says) {
    lines.push_back("bending yes");
    REQUIRE_THROWS_WITH(example("pvp", lines), Contains(says));
  };
  refused({"stress law giesekus", "stress law mobility 0.1"}, "expected stress law maxwell");
  refused({"solvent viscosity 1"}, "without yield stress, hbfluid or solvent viscosity");
  refused({"integrator kencarp5"}, "expected integrator verner6 or dopri5");
  REQUIRE_THROWS_WITH(example("straight-jet", {"bending yes"}), Contains("does not bend"));
  CHECK_NOTHROW(example("pvp", {"bending yes"}));
}
