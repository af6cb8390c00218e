/// Splits and merges of elements: what they keep, how well they draw a curve, and which the rule asks for.

#include "core/jet/refinement.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "core/jet/spacing.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;
using std::numbers::pi;
using Index = Eigen::Index;

namespace {

/// A helix that widens, of n alike elements and a bead on top, moving and under stress; dual cells.
Jet<3> coil(int n, double turns = 3) {
  std::vector<Bead<3>> beads;
  for (int i = 0; i <= n; ++i) {
    const double s = 1 - double(i) / n, phase = 2 * pi * turns * s, radius = 1 + s;
    const Vec<3> around(0, std::cos(phase), std::sin(phase));
    beads.push_back({Vec<3>(10 * s, 0, 0) + radius * around,
                     Vec<3>(5 + 3 * s, 0, 0) + radius * Vec<3>(0, -around[2], around[1]),
                     2 + std::sin(phase) + s, i == 0 ? 0.5 : 1, i == 0 ? 0.5 : 1});
  }
  return jet_of<3>(beads);
}

struct Sums {
  double mass, charge, volume, stress;
  Vec<3> momentum;
};

Sums sums(const Jet<3>& jet) {
  const auto velocity = jet.y.middleCols<3>(velocity_column<3>);
  return {jet.mass.sum(), jet.charge.sum(), jet.volume.sum(),
          (jet.volume * jet.y.col(stress_column<3>)).sum(),
          (velocity.colwise() * jet.mass).colwise().sum().matrix().transpose()};
}

void check_same(const Sums& a, const Sums& b, double round_off) {
  CHECK(a.mass == Approx(b.mass).epsilon(round_off));
  CHECK(a.charge == Approx(b.charge).epsilon(round_off));
  CHECK(a.volume == Approx(b.volume).epsilon(round_off));
  CHECK(a.stress == Approx(b.stress).epsilon(round_off));
  CHECK((a.momentum - b.momentum).norm() < round_off * b.momentum.norm());
}

std::vector<Index> some(std::mt19937& random, Index first, Index last, Index apart) {
  std::vector<Index> rows;
  for (Index i = first; i < last; ++i)
    if (random() % 8 == 0) rows.push_back(i), i += apart - 1;
  return rows;
}

double shortest(const Jet<3>& jet) {
  double least = 1e300;
  for (Index i = 0; i + 1 < jet.size(); ++i)
    least = std::min(least, (position<3>(jet.y, i) - position<3>(jet.y, i + 1)).norm());
  return least;
}

Parameters refining(const std::vector<std::string>& more) {
  std::vector<std::string> all = {"dynamic refinement yes", "self field slender"};
  all.insert(all.end(), more.begin(), more.end());
  return example("pvp", all);
}

}  // namespace

TEST_CASE("A split and a merge keep mass, charge, volume, stress by volume and momentum") {
  Jet<3> jet = coil(64);
  jet.volume[20] = 0.7, jet.volume[21] = 1.9, jet.charge[20] = 2.3;  // whatever it is made of
  const Sums before = sums(jet);
  split<3>(jet, {0, 1, 7, 19, 20, 21, 62});
  REQUIRE(jet.size() == 65 + 7);
  check_same(sums(jet), before, 1e-14);  // round-off of sums over 72 rows
  merge<3>(jet, {1, 3, 8, 22, 50, 70});
  REQUIRE(jet.size() == 65 + 1);
  check_same(sums(jet), before, 1e-14);
}

TEST_CASE(
    "Ten thousand splits and merges of a coil that moves keep all sums, and radius and stress positive") {
  Jet<3> jet = coil(200);
  const Sums before = sums(jet);
  const auto stress = jet.y.col(stress_column<3>).head(200);
  const double least = stress.minCoeff(), greatest = stress.maxCoeff();
  std::mt19937 random(3);
  Index changes = 0;
  for (int round = 0; changes < 10000; ++round) {
    const auto elements = some(random, 0, jet.size() - 1, 1);
    split(jet, elements);
    while (jet.size() > 201) {
      const auto beads = some(random, 1, jet.size() - 1, 2);
      merge(jet, beads);
      changes += std::ssize(beads);
    }
    changes += std::ssize(elements);
    jet.y.leftCols<3>() += 1e-3 * jet.y.middleCols<3>(velocity_column<3>);
    REQUIRE(jet.size() > 50);
    REQUIRE(jet.volume.minCoeff() > 0);
    REQUIRE(jet.mass.minCoeff() > 0);
    REQUIRE(shortest(jet) > 0);
    const auto now = jet.y.col(stress_column<3>).head(jet.size() - 1);
    REQUIRE(now.minCoeff() > least * (1 - 1e-12));
    REQUIRE(now.maxCoeff() < greatest * (1 + 1e-12));
  }
  check_same(sums(jet), before, 1e-11);  // a round-off a change
}

TEST_CASE("A merge undoes a split, of elements that are not neighbours") {
  const Jet<3> before = coil(40);
  Jet<3> jet = before;
  split<3>(jet, {0, 5, 7, 20, 39});
  CHECK((jet.mass > 0).all());
  merge<3>(jet, {1, 7, 10, 24, 44});
  REQUIRE(jet.size() == before.size());
  CHECK((jet.y - before.y).abs().maxCoeff() < 1e-13);
  CHECK((jet.mass - before.mass).abs().maxCoeff() == 0);
  CHECK((jet.volume - before.volume).abs().maxCoeff() == 0);
}

TEST_CASE("A straight thread that stretches uniformly keeps its shape, its rate and its stress exactly") {
  std::vector<Bead<3>> beads;
  for (int i = 16; i >= 0; --i) beads.push_back({Vec<3>(2 * i, i, -i), Vec<3>(4 * i, 2 * i, -2 * i), 1.5});
  Jet<3> jet = jet_of<3>(beads);
  split<3>(jet, {1, 2, 3, 8, 14});
  split<3>(jet, {2, 3, 4});
  for (Index i = 0; i < jet.size(); ++i) {
    const Vec<3> r = position<3>(jet.y, i);
    // round-off of weights and of the momentum's share
    CHECK((r - r[0] * Vec<3>(1, 0.5, -0.5)).norm() < 1e-13);
    CHECK((velocity<3>(jet.y, i) - 2 * r).norm() < 1e-12);
    CHECK(jet.y(i, stress_column<3>) == 1.5);
  }
  for (Index i = 0; i + 1 < jet.size(); ++i)
    CHECK((jet.y(i, 0) - jet.y(i + 1, 0)) / jet.volume[i] == Approx(2).epsilon(1e-13));
}

TEST_CASE("New beads lie on a circle, and move with it, to fourth order in the element") {
  std::array<double, 2> off{}, slow{};
  for (std::size_t k = 0; k < 2; ++k) {
    const int n = k == 0 ? 32 : 64;
    std::vector<Bead<3>> beads;
    for (int i = 0; i <= n; ++i) {
      const double phase = 4.5 * i / n;
      beads.push_back(
          {Vec<3>(0, std::cos(phase), std::sin(phase)), Vec<3>(0, -std::sin(phase), std::cos(phase)), 1});
    }
    Jet<3> jet = jet_of<3>(beads);
    split<3>(jet, {n / 2});
    off[k] = std::abs(position<3>(jet.y, n / 2 + 1).norm() - 1);
    // before momentum is made good, which moves three beads by second order
    slow[k] = std::abs(velocity<3>(jet.y, n / 2 + 1).dot(position<3>(jet.y, n / 2 + 1)));
  }
  CHECK(std::log2(off[0] / off[1]) > 3.9);
  CHECK(off[0] < 2e-5);
  CHECK(slow[0] < 1e-14);
}

TEST_CASE("Both halves of a split have stress and radius between those of their neighbours") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uneven(0.2, 1.8);
  std::vector<Bead<3>> beads;
  double x = 0;
  for (int i = 0; i < 60; ++i)
    beads.push_back({Vec<3>(x -= uneven(random), 0.05 * std::sin(i), 0), Vec<3>::Zero(), uneven(random)});
  const Jet<3> before = jet_of<3>(beads);
  const auto stretch = [](const Jet<3>& jet, Index i) {
    return (position<3>(jet.y, i) - position<3>(jet.y, i + 1)).norm() / jet.volume[i];
  };
  for (Index e = 1; e < 57; ++e) {
    Jet<3> jet = before;
    split<3>(jet, {e});
    const auto between = [&](double value, double a, double b, double slack) {
      return value >= std::min(a, b) - slack && value <= std::max(a, b) + slack;
    };
    const auto sigma = before.y.col(stress_column<3>);
    CHECK(between(jet.y(e, stress_column<3>), sigma[e - 1], sigma[e], 0));
    CHECK(between(jet.y(e + 1, stress_column<3>), sigma[e], sigma[e + 1], 0));
    // the new bead stands beside the chord, which makes the halves longer than it by second order
    const double l = stretch(before, e), bend = 0.02 * l;
    CHECK(between(stretch(jet, e), stretch(before, e - 1), l, bend));
    CHECK(between(stretch(jet, e + 1), l, stretch(before, e + 1), bend));
  }
}

TEST_CASE("The rule splits what turns too much, a larger neighbour first, and merges what has straightened") {
  const Parameters p = refining({"dynamic refinement tolerance 2.d-3"});
  const Spacing<3> spacing(p);
  const Jet<3> once = [&] {
    Jet<3> jet = coil(40);
    jet.y.leftCols<3>() *= 10;  // slender: elements long against the radius
    refine(jet, spacing.refinement(jet));
    return jet;
  }();
  REQUIRE(once.size() > 80);
  CHECK(spacing.refinement(once).empty());  // it settles
  const double most_turn = std::sqrt(24 * 2e-3);
  for (Index i = 1; i + 4 < once.size(); ++i) {
    const Vec<3> a = position<3>(once.y, i - 1) - position<3>(once.y, i),
                 b = position<3>(once.y, i) - position<3>(once.y, i + 1);
    CHECK((a.normalized() - b.normalized()).norm() < most_turn);
    CHECK(once.volume[i] / once.volume[i - 1] == Approx(1).margin(1));
    CHECK(once.volume[i - 1] / once.volume[i] == Approx(1).margin(1));
  }
  Jet<3> straight = once;
  straight.y.col(1).setZero();
  straight.y.col(2).setZero();
  refine(straight, spacing.refinement(straight));
  // all but those beside the youngest three, which may not be coarser than these
  CHECK(straight.size() <= 44);
}

TEST_CASE("Elements are left alone once their halves would be shorter than twice their radius") {
  const Parameters p = refining({"dynamic refinement tolerance 1.d-6"});
  Jet<3> jet = coil(40);
  jet.y.leftCols<3>() *= 2;
  refine(jet, Spacing<3>(p).refinement(jet));
  const double a = p.nozzle_cross / scales(p).length, L_step = groups(p).L_step;
  for (Index i = 0; i + 4 < jet.size(); ++i) {
    const double l = (position<3>(jet.y, i) - position<3>(jet.y, i + 1)).norm();
    const double radius = a * std::sqrt(jet.volume[i] * L_step / l);
    CHECK(l > 1.9 * radius);  // halves of an arc are not quite alike
  }
}

TEST_CASE("Beads of a jet that refines have ids, given at birth and never twice") {
  Jet<3> jet = coil(10);
  jet.removed = 7;
  number_beads(jet);
  split<3>(jet, {3});
  drop_first(jet);
  append(jet, Bead<3>(Vec<3>(-1, 0, 0)));
  const std::vector<std::int64_t> expected = {9, 10, 11, 19, 12, 13, 14, 15, 16, 17, 18, 20};
  CHECK(std::vector<std::int64_t>(jet.id.begin(), jet.id.end()) == expected);
}

TEST_CASE("Looks that a deck asks for begin at its start, on their own grid") {
  Parameters p = plain_parameters();  // the unit of time is 1 s
  p.refinement = true;
  p.refinement_threshold = 2;
  p.refinement_every = 0.1;
  p.refinement_start = 0.25;
  const Spacing<3> spacing(p);
  CHECK(spacing.next(0) == Approx(0.3).epsilon(1e-14));
  CHECK(spacing.next(0.3) == Approx(0.4).epsilon(1e-14));
  for (std::int64_t k = 4; k < 1'000'000'000; k += 1 + k / 7) {
    const double t = double(k) * 0.1;
    CHECK(spacing.next(t) == Approx(t + 0.1).epsilon(1e-14));
    CHECK(spacing.due(t, false));
  }
  CHECK_FALSE(spacing.due(0.2, true));
  CHECK(spacing.due(0.3, false));
  CHECK_FALSE(spacing.due(0.35, true));
}

namespace {

/// A straight jet of such elements, each bead with half of the two at it.
Jet<3> straight_jet(const std::vector<double>& volume, double length_of_unit) {
  Jet<3> jet;
  double x = 0;
  for (std::size_t i = volume.size(); i-- > 0;) {
    x += volume[i] * length_of_unit;
    Bead<3> bead(Vec<3>(x, 0, 0));
    bead.volume = volume[i];
    bead.mass = bead.charge = i > 0 ? (volume[i - 1] + volume[i]) / 2 : volume[0];
    append<3>(jet, bead);
  }
  Jet<3> turned = jet;  // beads stand from the collector on
  for (Eigen::Index i = 0; i < jet.size(); ++i) {
    const Eigen::Index k = jet.size() - 1 - i;
    turned.y.row(i) = jet.y.row(k);
    for (auto each : {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume}) (turned.*each)[i] = (jet.*each)[k];
  }
  return turned;
}

Spacing<3> spacing(double threshold) {
  Parameters p = plain_parameters();
  p.refinement = true;
  p.refinement_threshold = threshold;
  return Spacing<3>(p);
}

}  // namespace

TEST_CASE("Elements merge from the smallest on, so that neighbours stay within a factor of two") {
  const Jet<3> jet = straight_jet({1, 0.5, 0.5, 0.25, 0.25, 0.5, 1, 1, 1, 1, 1}, 0.1);
  const Refinement refinement = spacing(10).refinement(jet);
  REQUIRE(refinement.size() > 1);
  CHECK(refinement[0].rows == std::vector<Eigen::Index>{4});  // the quarters; the halves beside one wait
}

TEST_CASE("Two elements merge where together they are shorter than half the longest that may be") {
  const std::vector<double> halves(12, 0.5);
  CHECK(spacing(2).refinement(straight_jet(halves, 1.2)).empty());  // 0.6 + 0.6
  CHECK_FALSE(spacing(2).refinement(straight_jet(halves, 0.9)).empty());
}

TEST_CASE(
    "A part of a jet knows which beads merge if one of its own before them does not: pairs begin anew "
    "there") {
  Jet<3> part = straight_jet(std::vector<double>(24, 0.25), 0.1);
  part.from_oldest = false;
  CHECK_FALSE(spacing(10).asking(RefinementPass::Kind::merge, part, {6, 12}).has_value());
  part.volume[3] = 0.3;  // no merge at either of its beads, 3 and 4
  const auto told = spacing(10).asking(RefinementPass::Kind::merge, part, {6, 12});
  REQUIRE(told.has_value());
  CHECK(*told == std::vector<Eigen::Index>{7, 9, 11});  // after 5
}

TEST_CASE("Elements are not split where their halves would be shorter than twice their radius") {
  // a bead of volume 1 and length 10: radius 0.1 / sqrt(10)
  CHECK_FALSE(spacing(2).refinement(straight_jet(std::vector<double>(12, 1), 10)).empty());
  Parameters p = plain_parameters();
  p.nozzle_cross = 30;  // of length 10 the radius is 9.5
  p.refinement = true;
  p.refinement_threshold = 2;
  CHECK(Spacing<3>(p).refinement(straight_jet(std::vector<double>(12, 1), 10)).empty());
}

TEST_CASE(
    "An element waits for a larger neighbour, which is split first, and the youngest ones are left alone") {
  Jet<3> jet = straight_jet({1, 0.5, 1, 1, 1, 1, 1, 1}, 1);
  for (Eigen::Index bead : {0, 1}) jet.y(bead, 0) += 5;  // the second element is long now
  CHECK(spacing(2).refinement(jet)[0].rows == std::vector<Eigen::Index>{0, 2});
  const auto all = spacing(2).refinement(straight_jet(std::vector<double>(12, 1), 10))[0].rows;
  CHECK(all.size() == 9);
  CHECK(all.back() == 8);
}

namespace {

/// The coil, dried unevenly: what is left of the solvent of its elements is the first of two added columns.
Jet<3> dried_coil(int n) {
  Jet<3> jet = coil(n);
  State<3> y(jet.size(), own_columns<3> + 2);
  y.leftCols<own_columns<3>>() = jet.y;
  for (Index i = 0; i < jet.size(); ++i) {
    const double s = double(i) / n;
    y(i, own_columns<3>) = 0.1 + 0.7 * s + 0.1 * std::sin(9 * s);
    y(i, own_columns<3> + 1) = std::cos(5 * s);
  }
  jet.y = y;
  return jet;
}

constexpr Index solvent = own_columns<3>, of_bead = solvent + 1;

}  // namespace

TEST_CASE("Splits and merges of a jet that dries keep its polymer and its solvent, and dry no element more") {
  Jet<3> jet = dried_coil(200);
  const auto all_solvent = [&] { return (jet.volume * jet.y.col(solvent)).head(jet.size() - 1).sum(); };
  const double polymer = jet.volume.sum(), before = all_solvent();
  const double least = jet.y.col(solvent).minCoeff(), most = jet.y.col(solvent).maxCoeff();
  std::mt19937 random(5);
  for (int round = 0; round < 100; ++round) {
    split(jet, some(random, 0, jet.size() - 1, 1));
    while (jet.size() > 201) merge(jet, some(random, 1, jet.size() - 1, 2));
    REQUIRE(jet.y.col(solvent).minCoeff() > least * (1 - 1e-12));
    REQUIRE(jet.y.col(solvent).maxCoeff() < most * (1 + 1e-12));
  }
  // a round-off a change, of which there are 5000; polymer is a fixed part of the volume at the nozzle
  CHECK(jet.volume.sum() == Approx(polymer).epsilon(1e-12));
  CHECK(all_solvent() == Approx(before).epsilon(1e-12));
}

TEST_CASE("A column of beads is interpolated to fourth order by a split, and given back by a merge") {
  std::vector<double> off;
  for (const int n : {32, 64, 128}) {
    const Jet<3> before = dried_coil(n);
    Jet<3> jet = before;
    const Index e = n / 2;
    split<3>(jet, {e}, {of_bead});
    off.push_back(std::abs(jet.y(e + 1, of_bead) - std::cos(5 * (double(e) + 0.5) / n)));
    CHECK(jet.y(e, of_bead) == before.y(e, of_bead));
    CHECK(jet.y(e + 2, of_bead) == before.y(e + 1, of_bead));
    merge<3>(jet, {e + 1}, {of_bead});
    CHECK((jet.y.col(of_bead) == before.y.col(of_bead)).all());
  }
  CHECK(orders(off)[1] > 3.8);
}

TEST_CASE("Splits of a jet know which columns a scene has for beads") {
  Parameters p = plain_parameters();
  p.refinement = true;
  p.refinement_threshold = 2;
  Jet<3> jet = dried_coil(24);
  jet.y.leftCols<3>() *= 10;
  const Columns added = {{.name = "solvent", .unit = "1"}, {.name = "moment", .unit = "1", .of_bead = true}};
  const Refinement refinement = Spacing<3>(p, added).refinement(jet);
  REQUIRE_FALSE(refinement.empty());
  for (const RefinementPass& pass : refinement) CHECK(pass.of_beads == std::vector<Index>{of_bead});
  const Index e = refinement[0].rows[2];
  const double there = jet.y(e, of_bead);
  refine(jet, refinement[0]);
  CHECK(jet.y(e + 2, of_bead) == there);
}
