#include "validation/support/scaling_model.hpp"

#include <algorithm>

#include "forces/coulomb/tree/tree_field.hpp"
#include "validation/support/coulomb_trial.hpp"

namespace treejet {

namespace {

/// A summary needs no more points of its subdomain than about so many.
constexpr int enough_for_a_summary = 10'000;

Rows share(int points, int ranks, int k) {
  const auto border = [&](int rank) { return static_cast<int>(std::int64_t{points} * rank / ranks); };
  return {border(k), border(k + 1)};
}

}  // namespace

Volume volume(const LongChain& chain, int points, int ranks, const TreeShape& shape) {
  TreeField field;
  const EssentialTree others(ranks);
  std::vector<std::vector<double>> summaries;
  // whole leaves, so that their radii are right
  const int stride = std::max(1, points / ranks / enough_for_a_summary);
  for (int k = 0; k < ranks; ++k) {
    TreeShape without_moments = shape;
    without_moments.order = 2;  // nobody looks at them
    field.arrange(chain.points(points, share(points, ranks, k), stride, shape.leaf).view(), without_moments,
                  {1});
    summaries.push_back(others.summary(field.tree()));
  }
  Volume most;
  for (const int k : {ranks / 2, ranks - 1}) {
    field.arrange(chain.points(points, share(points, ranks, k)).view(), shape, {1});
    Volume own;
    const double seconds = least_seconds([&] {
      own = {};
      for (int other = 0; other < ranks; ++other) {
        if (other == k) continue;
        const double* summary = summaries[static_cast<std::size_t>(other)].data();
        const auto words = others.message(field.tree(), summary, shape.opening).size();
        own.messages += static_cast<double>(words * sizeof(double));
        own.partners += words > 0;
      }
    });
    own.seconds_a_summary = seconds / std::max(1, ranks - 1);
    if (own.messages >= most.messages) most = own;
    most.summaries = static_cast<double>((ranks - 1) * others.summary(field.tree()).size() * sizeof(double));
  }
  return most;
}

/// Summaries by a ring or by doubling, lengths of messages by Bruck's algorithm, sum and greatest number by
/// trees, messages one by one.
double ScalingModel::messages(double ranks, const Volume& v) const {
  return ranks > 1 ? 6 * std::ceil(std::log2(ranks)) + v.partners : 0;
}

double ScalingModel::seconds(double points, double ranks, const Volume& v) const {
  const double lengths = sizeof(int) * ranks / 2 * std::ceil(std::log2(ranks));
  return seconds_a_point * points / ranks + seconds_a_summary * (ranks - 1) + latency * messages(ranks, v) +
         (v.summaries + v.messages + lengths) / bandwidth;
}

}  // namespace treejet
