/// Summaries of groups of ranks, of which a rank sees few and yet all others: without ranks.

#include <catch2/catch.hpp>

#include "forces/coulomb/tree/multipole.hpp"
#include "validation/support/rank_volume.hpp"

using namespace treejet;

namespace {

const TreeShape shape{.order = 6, .opening = 0.5, .leaf = 16};

/// Subdomain k of a coil, whose turns are near each other, cut into so many; none for every seventh.
PointSet subdomain(const PointSet& all, int ranks, int k) {
  PointSet some;
  if (k % 7 == 3) return some;
  for (int i = all.size() * k / ranks; i < all.size() * (k + 1) / ranks; ++i)
    some.add({all.r[0][index(i)], all.r[1][index(i)], all.r[2][index(i)]}, all.q[index(i)]);
  return some;
}

/// Charges tell ranks apart, so many at a time: the monopole of a summary is then a sum of powers of two,
/// which is exact.
constexpr int at_a_time = 50;

double charge(int rank, int window) {
  if (rank % 7 == 3 || rank / at_a_time != window) return 0;
  return std::ldexp(1, rank % at_a_time);
}

std::vector<Summary> told_apart(const PointSet& all, int ranks, int window) {
  std::vector<Summary> summaries;
  for (int k = 0; k < ranks; ++k) {
    SubdomainTree tree(subdomain(all, ranks, k), shape);
    tree.equalise(tree.spread());
    Summary& own = summaries.emplace_back(EssentialTree::own_summary(tree.tree(), ranks));
    if (!own.empty()) own.moments[0] = charge(k, window);
  }
  return summaries;
}

double largest_distance(const PointSet& points, const double (&centre)[3]) {
  double most = 0;
  for (std::size_t i = 0; i < points.q.size(); ++i)
    most = std::max(
        most, std::hypot(points.r[0][i] - centre[0], points.r[1][i] - centre[1], points.r[2][i] - centre[2]));
  return most;
}

}  // namespace

TEST_CASE("A rank sees every other subdomain once, and is near to whom is near to it") {
  const PointSet all = coil(6000, 10, 0.3);
  const int levels_of_table = GENERATE(9, 1);  // all ranks in the table, and two groups of them
  for (const int ranks : {2, 3, 5, 8, 13, 29, 50, 90}) {
    std::vector<std::vector<int>> near(index(ranks));
    std::size_t far = 0, written_to = 0;
    for (int window = 0; window <= (ranks - 1) / at_a_time; ++window) {
      const GroupSummaries groups(told_apart(all, ranks, window), shape, levels_of_table);
      double total = 0;
      for (int k = 0; k < ranks; ++k) total += charge(k, window);
      for (int k = 0; k < ranks; ++k) {
        CAPTURE(levels_of_table, ranks, window, k);
        const SummaryTree seen = groups.seen_by(k);
        double sum = charge(k, window);
        near[index(k)].clear();
        for (const Summary& group : seen.far()) sum += group.moments[0];
        for (const SummaryTree::Near& one : seen.near()) {
          sum += one.summary.moments[0];
          near[index(k)].push_back(one.group);
        }
        CHECK(sum == total);
        far += seen.far().size();
        written_to += seen.near().size();
      }
    }
    for (int a = 0; a < ranks; ++a)
      for (const int b : near[index(a)])
        CHECK(std::count(near[index(b)].begin(), near[index(b)].end(), a) == 1);
    if (ranks < 13) continue;
    CHECK(written_to > 0);  // else nobody would be near
    CHECK(far > 0);
  }
}

TEST_CASE("Rounds of summaries match: whoever waits for a message in a round is sent one") {
  const PointSet all = coil(6000, 10, 0.3);
  const int levels_of_table = GENERATE(9, 3, 1);
  for (const int ranks : {2, 3, 6, 11, 90}) {
    std::vector<SummaryTree> trees;
    const std::vector<Summary> own = told_apart(all, ranks, 0);
    for (int k = 0; k < ranks; ++k)
      trees.emplace_back(k, ranks, levels_of_table).begin(own[index(k)], shape, wide_kernels(default_isa()));
    for (int round = 0; round < trees[0].rounds(); ++round) {
      std::vector<SummaryTree::Round> all_of_it;
      for (const SummaryTree& tree : trees) all_of_it.push_back(tree.round(round));
      std::size_t sent = 0, awaited = 0;
      for (int k = 0; k < ranks; ++k) {
        std::vector<std::vector<double>> in;
        for (const int from : all_of_it[index(k)].from) {
          CAPTURE(levels_of_table, ranks, round, k, from);
          const SummaryTree::Round& theirs = all_of_it[index(from)];
          REQUIRE(std::count(theirs.to.begin(), theirs.to.end(), k) == 1);
          in.push_back(theirs.message);
        }
        sent += all_of_it[index(k)].to.size(), awaited += in.size();
        trees[index(k)].take(round, in);
      }
      CHECK(sent == awaited);
    }
  }
}

TEST_CASE("Neighbours joined have the moments of all their points, in a ball that holds them") {
  const PointSet all = coil(2000, 2, 0.3);  // more leaves than balls stay
  const WideKernels& kernels = wide_kernels(default_isa());
  std::vector<Summary> halves;
  for (const int k : {0, 1}) {
    SubdomainTree half(subdomain(all, 2, k), shape);
    Summary& own = halves.emplace_back(EssentialTree::own_summary(half.tree(), 2));
    own.critical_radius = (k == 0 ? 1.2 : 0.9) * own.whole.radius;
    const PointSet points = subdomain(all, 2, k);
    Series moments(shape.order - 1);
    for (std::size_t i = 0; i < points.q.size(); ++i)
      p2m({own.whole.centre[0] - points.r[0][i], own.whole.centre[1] - points.r[1][i],
           own.whole.centre[2] - points.r[2][i]},
          points.q[i], moments);
    std::copy_n(moments.data(), Series::terms(shape.order - 1), own.moments.data());
  }
  const Summary both = joined(halves[0], halves[1], shape.order, kernels);
  Series expected(shape.order - 1);
  double size = 0;
  for (int i = 0; i < all.size(); ++i) {
    const std::size_t k = index(i);
    p2m({both.whole.centre[0] - all.r[0][k], both.whole.centre[1] - all.r[1][k],
         both.whole.centre[2] - all.r[2][k]},
        all.q[k], expected);
  }
  for (int k = 0; k < Series::terms(shape.order - 1); ++k)
    size = std::max(size, std::abs(expected.data()[k]));
  for (int k = 0; k < Series::terms(shape.order - 1); ++k)
    CHECK(both.moments[index(k)] == Approx(expected.data()[k]).margin(1e-13 * size));  // roundings
  CHECK(both.critical_radius == Approx(1.2 * both.whole.radius).epsilon(1e-15));       // two roundings
  CHECK(both.balls.size() < halves[0].balls.size());
  CHECK(largest_distance(all, both.whole.centre) <= both.whole.radius * (1 + 1e-12));
  for (std::size_t i = 0; i < all.q.size(); ++i) {
    double out = 1e300;
    for (const Ball& ball : both.balls)
      out = std::min(out, std::hypot(all.r[0][i] - ball.centre[0], all.r[1][i] - ball.centre[1],
                                     all.r[2][i] - ball.centre[2]) -
                              ball.radius);
    CHECK(out <= 1e-12);
  }
}

TEST_CASE("A ball closes a cell to the nearest leaf that it may hold, and to none that is nearer") {
  constexpr double opening = 0.5, radius = 1, leaf = 0.1, cell = 0.2;
  const Ball ball{{3, -1, 2}, radius, leaf};
  // the nearest leaf lies on the ball: the cell is far from it beyond (cell + leaf) / opening
  const double border = radius + (cell + leaf) / opening;
  const BoundaryTree alone({&ball, 1}, opening);
  for (const double way : {border * (1 - 1e-9), border * (1 + 1e-9)}) {
    // (2, 1, 2) / 3 has length 1
    const double centre[3] = {3 + way * 2 / 3, -1 + way / 3, 2 + way * 2 / 3};
    CHECK(closes(ball, centre, cell, opening) == (way > border));
    CHECK(alone.closes(centre, cell) == (way > border));
  }
}

TEST_CASE(
    "Eight times as many ranks meet hardly more summaries, where a table would be eight times as long") {
  const PointSet all = coil(32'000, 4, 1);
  std::int64_t most[2] = {};
  for (const bool many : {false, true}) {
    const int ranks = many ? 2048 : 256;
    std::vector<Summary> own;
    for (int k = 0; k < ranks; ++k) {
      // as long in both cases: as many neighbours
      SubdomainTree tree(subdomain(all, 2048, k), shape);
      tree.equalise(tree.spread());
      own.push_back(EssentialTree::own_summary(tree.tree(), 2048));
    }
    const GroupSummaries groups(std::move(own), shape, /*levels_of_table*/ 5);
    for (int k = 0; k < ranks; k += 16) most[many] = std::max(most[many], groups.traffic_of(k).message_bytes);
  }
  // three levels more below the table, beside three
  CHECK(double(most[1]) < 2.5 * double(most[0]));
}
