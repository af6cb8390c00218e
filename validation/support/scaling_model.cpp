#include "validation/support/scaling_model.hpp"

#include <algorithm>
#include <cmath>

#include "validation/support/coulomb_trial.hpp"
#include "validation/support/rank_volume.hpp"

namespace treejet {

namespace {

/// A summary needs no more points of its subdomain than about so many.
constexpr int enough_for_a_summary = 10'000;
/// Nor the mean spread of leaves more subdomains.
constexpr int enough_for_a_mean = 1000;

Rows share(int points, int ranks, int k) {
  const auto border = [&](int rank) { return static_cast<int>(std::int64_t{points} * rank / ranks); };
  return {border(k), border(k + 1)};
}

}  // namespace

Volume volume(const LongChain& chain, int points, int ranks, const TreeShape& shape) {
  const EssentialTree others(ranks);
  std::vector<std::vector<double>> summaries;
  // whole leaves, so that their radii are right
  const int stride = std::max(1, points / ranks / enough_for_a_summary);
  const auto tree_of = [&](int k, int every) {
    return SubdomainTree(chain.points(points, share(points, ranks, k), every, shape.leaf), shape);
  };
  Cells::Spread all{};
  for (int k = 0; k < ranks; k += std::max(1, ranks / enough_for_a_mean)) {
    const Cells::Spread own = tree_of(k, stride).spread();
    all.sum += own.sum, all.points += own.points;
  }
  for (int k = 0; k < ranks; ++k) {
    SubdomainTree tree = tree_of(k, stride);
    tree.equalise(all);
    summaries.push_back(others.summary(tree.tree()));
  }
  Volume most;
  for (const int k : {ranks / 2, ranks - 1}) {
    SubdomainTree subdomain = tree_of(k, 1);
    subdomain.equalise(all);
    const Tree& tree = subdomain.tree();
    Volume own;
    const double seconds = least_seconds([&] {
      own = {};
      for (int other = 0; other < ranks; ++other) {
        if (other == k) continue;
        const double* summary = summaries[static_cast<std::size_t>(other)].data();
        const auto words = others.message(tree, summary, shape.opening).size();
        own.messages += static_cast<double>(words * sizeof(double));
        own.partners += words > 0;
      }
    });
    own.seconds_a_summary = seconds / std::max(1, ranks - 1);
    if (own.messages >= most.messages) most = own;
    most.common = common_traffic(ranks, summaries.front().size());
  }
  return most;
}

/// Summaries, lengths of messages (Bruck's algorithm) and decisions by doubling, a sum up a tree and down
/// again, messages one by one.
double ScalingModel::messages(double ranks, const Volume& v) const {
  const RankTraffic& c = v.common;
  const auto rounds = static_cast<double>(c.tables + c.exchanges + c.decisions + 2 * c.sums);
  return ranks > 1 ? rounds * std::ceil(std::log2(ranks)) + v.partners : 0;
}

double ScalingModel::seconds_for_cards(double ranks, const Volume& v) const {
  const double lengths = sizeof(int) * ranks / 2 * std::ceil(std::log2(ranks));
  return seconds_a_summary * (ranks - 1) + (static_cast<double>(v.common.table_bytes) + lengths) / bandwidth;
}

double ScalingModel::seconds(double points, double ranks, const Volume& v) const {
  return seconds_a_point * points / ranks + seconds_for_cards(ranks, v) + latency * messages(ranks, v) +
         v.messages / bandwidth;
}

}  // namespace treejet
