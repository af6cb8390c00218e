/// The slender self-field where elements of unequal length meet.

#include "forces/terms/joints.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <numbers>

#include "core/jet/decomposition.hpp"
#include "core/jet/refinement.hpp"
#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;
using std::numbers::pi;
using Index = Eigen::Index;

namespace {

using Curve = Vec<3> (*)(double s);

Vec<3> rod(double s) {
  return {s + 0.15 * std::sin(pi * s / 2), 0, 0};
}
Vec<3> helix(double s) {
  const double R = 0.1 + 0.05 * s, turn = 2 * pi * s;
  return {s + 0.1 * s * s, R * std::cos(turn), R * std::sin(turn)};
}
Vec<3> lobes(double s) {
  const double R = 1 + 0.3 * std::cos(3 * s), turn = 1.5 * s;
  return {0.1 * s, R * std::cos(turn), R * std::sin(turn)};
}
Vec<3> ring(double s) {
  return {0, std::cos(1.5 * s), std::sin(1.5 * s)};
}

/// 0 <= s <= 4 in elements of 1 / k, in every other quarter of 1 / (2 k); or all of 1 / k.
std::vector<double> volumes(int k, bool jumps) {
  std::vector<double> v;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int n = jumps && quarter % 2 == 1 ? 2 * k : k;
    v.insert(v.end(), static_cast<std::size_t>(n), 1.0 / n);
  }
  return v;
}

/// A thread with half a bead at both ends, charge and mass 1 for each s, the nozzle far away; its beads' s.
struct Thread {
  Jet<3> jet;
  std::vector<double> s;

  Thread(Curve curve, const std::vector<double>& v) {
    std::vector<Bead<3>> beads;
    double at = 0;
    for (std::size_t i = 0; i <= v.size(); ++i) {
      const double below = i > 0 ? v[i - 1] : 0, above = i < v.size() ? v[i] : 0, cell = (below + above) / 2;
      s.push_back(at);
      beads.push_back({Vec<3>(100, 0, 0) + curve(at), Vec<3>::Zero(), 0, cell, cell});
      beads.back().volume = above > 0 ? above : below;
      at += above;
    }
    jet = jet_of<3>(beads);
  }
};

/// Force over charge on each bead.
State<3> push(const Thread& thread, bool joints) {
  constexpr int all_pairs = 1 << 30;
  auto f = equations<3>(plain_parameters(), CoulombForce<3>(1, all_pairs),
                        SlenderSelfField<3>(1, Section{1e-3, 1}, joints));
  return slope(f, thread.jet);
}

/// The force summed over a smooth weight that covers three joints.
Vec<3> smooth_push(Curve curve, int k, bool jumps, bool joints) {
  const Thread thread(curve, volumes(k, jumps));
  const State<3> dy = push(thread, joints);
  Vec<3> sum = Vec<3>::Zero();
  for (Index i = 0; i < thread.jet.size(); ++i) {
    const double off = (thread.s[static_cast<std::size_t>(i)] - 1.7) / 1.3;
    if (std::abs(off) < 1)
      sum += std::pow(std::cos(pi / 2 * off), 4) * thread.jet.mass[i] * velocity<3>(dy, i);
  }
  return sum;
}

}  // namespace

TEST_CASE(
    "Elements alike have no joints; at a jump of spacing tension goes from the large to the small ones") {
  CHECK((tension_of_joints(Eigen::ArrayXd::Constant(50, 0.3)) == 0).all());
  Eigen::ArrayXd v = Eigen::ArrayXd::Ones(100);
  v.tail(50) = 0.5;
  const Eigen::ArrayXd c = tension_of_joints(v);
  CHECK(c[49] == Approx(-0.129).margin(1e-3));
  CHECK(c[50] == Approx(0.410).margin(2e-3));
  CHECK(c[20] == Approx(-0.75 / 12 / (29.5 * 29.5)).epsilon(1e-2));  // far off, Euler and Maclaurin's
  CHECK((tension_of_joints(7 * v.reverse()).reverse() - c).abs().maxCoeff() < 1e-12);
}

TEST_CASE("A straight uniform thread is in balance at a jump of its spacing") {
  const Curve straight = [](double s) { return Vec<3>(s, 0, 0); };
  const Thread even(straight, volumes(32, false)), uneven(straight, volumes(16, true));
  const State<3> expected = push(even, false), with = push(uneven, true), without = push(uneven, false);
  double worst = 0, worst_without = 0;
  for (Index i = 0; i < uneven.jet.size(); ++i) {
    const double s = uneven.s[static_cast<std::size_t>(i)], cell = uneven.jet.mass[i];
    if (s < 0.5 || s > 3.5) continue;
    const auto j = static_cast<Index>(std::lround(32 * s));
    worst = std::max(worst, cell * std::abs(with(i, 3) - expected(j, 3)));
    worst_without = std::max(worst_without, cell * std::abs(without(i, 3) - expected(j, 3)));
  }
  // in units of lambda^2; what is left is made by the two lattices' own field, the joints left out
  CHECK(worst < 5e-3);
  CHECK(worst_without > 0.3);
}

TEST_CASE("Whatever jumps its spacing has, the force on a piece of a thread is of second order in it") {
  for (const Curve curve : {&rod, &helix, &lobes, &ring}) {
    const Vec<3> truth = smooth_push(curve, 256, false, false);
    std::vector<double> with, without;
    for (int k : {8, 16, 32}) {
      with.push_back((smooth_push(curve, k, true, true) - truth).norm() / truth.norm());
      without.push_back((smooth_push(curve, k, true, false) - truth).norm() / truth.norm());
    }
    CAPTURE(with, without);
    // the rod's last error is that of the truth, whose ends have the scale of the radius
    CHECK(std::log2(with[0] / with[1]) > 1.8);
    CHECK(with[2] < without[2]);
  }
}

TEST_CASE("Joints are those of the volumes now, though a jet has as many elements as before") {
  const auto jet = [](double oldest, double youngest) {
    Jet<3> all;
    double x = 6 * (oldest + youngest);
    for (int i = 0; i < 12; ++i) {
      const double V = i < 6 ? oldest : youngest;
      Bead<3> bead(Vec<3>(x, 0, 0));
      bead.volume = bead.mass = bead.charge = V;
      append<3>(all, bead);
      x -= V;
    }
    return all;
  };
  const Section section{0.05, 1};
  auto used = equations<3>(plain_parameters(), SlenderSelfField<3>(2, section, /*uneven*/ true));
  auto fresh = equations<3>(plain_parameters(), SlenderSelfField<3>(2, section, /*uneven*/ true));
  slope(used, jet(1, 0.5));
  CHECK((slope(used, jet(0.5, 1)) == slope(fresh, jet(0.5, 1))).all());
}

TEST_CASE("Joints of a jet whose beads are numbered follow it through splits, merges, arrivals and births") {
  const Section section{0.05, 1};
  const auto scene = [&] {
    return equations<3>(plain_parameters(), SlenderSelfField<3>(2, section, /*uneven*/ true));
  };
  auto used = scene();
  Jet<3> jet;
  for (int i = 0; i < 12; ++i) append<3>(jet, Bead<3>(Vec<3>(12 - i, 0.1 * (i % 3), 0)));
  number_beads(jet);
  // as many elements before and after all but the first two
  const std::vector<std::function<void()>> changes = {
      [&] { split<3>(jet, {3}); }, [&] { split<3>(jet, {6}); },
      [&] { split<3>(jet, {9}), merge<3>(jet, {4}); }, [&] { merge<3>(jet, {7}), split<3>(jet, {2}); },
      [&] { drop_first<3>(jet), append<3>(jet, Bead<3>(Vec<3>(0.2, 0, 0))); }};
  for (const auto& change : changes) {
    const State<3> before = slope(used, jet);
    change();
    auto fresh = scene();
    CHECK((slope(used, jet) == slope(fresh, jet)).all());
  }
}
