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
  std::vector<Summary> of_ranks;
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
    of_ranks.push_back(EssentialTree::own_summary(tree.tree(), ranks));
  }
  const GroupSummaries groups(std::move(of_ranks), shape);
  Volume most;
  for (const int k : {ranks / 2, ranks - 1}) {
    SubdomainTree subdomain = tree_of(k, 1);
    subdomain.equalise(all);
    Volume own;
    own.summaries = groups.traffic_of(k);
    own.seconds_for_summaries = least_seconds([&] {
      const SummaryTree seen = groups.seen_by(k);
      own.partners = static_cast<double>(seen.near().size());
      own.messages = 0;
      for (const SummaryTree::Near& near : seen.near())
        own.messages +=
            double(sizeof(double)) *
            static_cast<double>(EssentialTree::message(subdomain.tree(), near.summary, shape.opening).size());
    });
    if (own.messages >= most.messages) most = own;
  }
  return most;
}

/// Decisions by doubling, a sum up a tree and down again, messages one by one.
double ScalingModel::messages(double ranks, const Volume& v) const {
  const RankTraffic common = common_traffic();
  const auto rounds = static_cast<double>(common.decisions + 2 * common.sums);
  return ranks > 1 ? rounds * std::ceil(std::log2(ranks)) + double(v.summaries.messages) + v.partners : 0;
}

double ScalingModel::seconds_for_summaries(const Volume& v) const {
  return v.seconds_for_summaries + latency * double(v.summaries.messages) +
         double(v.summaries.message_bytes) / bandwidth;
}

double ScalingModel::seconds(double points, double ranks, const Volume& v) const {
  return seconds_a_point * points / ranks + seconds_for_summaries(v) +
         latency * (messages(ranks, v) - double(v.summaries.messages)) + v.messages / bandwidth;
}

}  // namespace treejet
