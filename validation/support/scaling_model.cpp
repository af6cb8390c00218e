#include "validation/support/scaling_model.hpp"

#include <algorithm>

#include "forces/coulomb/distributed/essential_tree.hpp"
#include "validation/support/coulomb_trial.hpp"

namespace treejet {

namespace {

/// A card needs no more points of its piece than about so many.
constexpr int enough_for_a_card = 10'000;

Rows share(int points, int ranks, int k) {
  const auto border = [&](int rank) { return static_cast<int>(std::int64_t{points} * rank / ranks); };
  return {border(k), border(k + 1)};
}

}  // namespace

Volume volume(const LongChain& chain, int points, int ranks, const TreeShape& shape) {
  EssentialTree tree({}, ranks, default_isa());
  std::vector<std::vector<double>> cards;
  // whole leaves, so that their radii are right
  const int stride = std::max(1, points / ranks / enough_for_a_card);
  for (int k = 0; k < ranks; ++k) {
    TreeShape without_moments = shape;
    without_moments.order = 2;  // nobody looks at them
    tree.plant(chain.points(points, share(points, ranks, k), stride, shape.leaf).view(), without_moments, {1},
               false);
    cards.push_back(tree.card());
  }
  Volume most;
  for (const int k : {ranks / 2, ranks - 1}) {
    tree.plant(chain.points(points, share(points, ranks, k)).view(), shape, {1}, false);
    Volume own;
    const double seconds = least_seconds([&] {
      own = {};
      for (int other = 0; other < ranks; ++other) {
        if (other == k) continue;
        const auto words = tree.letter(cards[static_cast<std::size_t>(other)].data(), shape.opening).size();
        own.letters += static_cast<double>(words * sizeof(double));
        own.partners += words > 0;
      }
    });
    own.seconds_a_card = seconds / std::max(1, ranks - 1);
    if (own.letters >= most.letters) most = own;
    most.cards = static_cast<double>((ranks - 1) * tree.card().size() * sizeof(double));
  }
  return most;
}

/// Cards by a ring or by doubling, lengths of letters by Bruck's algorithm, sum and greatest number by trees,
/// letters one by one.
double ScalingModel::messages(double ranks, const Volume& v) const {
  return ranks > 1 ? 6 * std::ceil(std::log2(ranks)) + v.partners : 0;
}

double ScalingModel::seconds(double points, double ranks, const Volume& v) const {
  const double lengths = sizeof(int) * ranks / 2 * std::ceil(std::log2(ranks));
  return seconds_a_point * points / ranks + seconds_a_card * (ranks - 1) + latency * messages(ranks, v) +
         (v.cards + v.letters + lengths) / bandwidth;
}

}  // namespace treejet
