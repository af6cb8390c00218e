#include "forces/coulomb/distributed/sample_distributed.hpp"

#include <algorithm>
#include <cmath>

namespace treejet {

DistributedSample::DistributedSample(DistributedTreeField& pieces, const Ranks& ranks, Isa isa,
                                     Threads threads)
    : ranks_(ranks) {
  // The size of the whole field, from the tree itself: it need not be exact.
  pieces.evaluate(threads);
  const double points = pieces.own_points();
  double squares[2] = {points * typical_square({pieces.sums(0), pieces.sums(1), pieces.sums(2)}), points};
  ranks_.sum(squares);
  points_ = squares[1];
  mean_square_ = squares[1] > 0 ? squares[0] / squares[1] : 0;

  const Spread all = spread(pieces);
  const auto me = index(ranks_.rank());
  leaves_.assign(all.leaves.begin() + all.borders[me], all.leaves.begin() + all.borders[me + 1]);
  first_ = all.borders[me] * pieces.shape().leaf;
  sum_directly(pieces, all, isa, threads);
}

DistributedSample::Spread DistributedSample::spread(const DistributedTreeField& pieces) const {
  const double own[] = {double(pieces.leaves())};
  std::vector<int> first = {0};
  for (double count : ranks_.of_all(own)) first.push_back(first.back() + static_cast<int>(count));

  Spread all;
  all.leaves =
      sample_leaves(first.back(), std::min(first.back(), sampled_points_of_pieces / pieces.shape().leaf));
  for (int border : first)
    all.borders.push_back(static_cast<int>(std::lower_bound(all.leaves.begin(), all.leaves.end(), border) -
                                           all.leaves.begin()));
  for (int rank = 0; rank < ranks_.size(); ++rank)
    for (int k = all.borders[index(rank)]; k < all.borders[index(rank) + 1]; ++k)
      all.leaves[index(k)] -= first[index(rank)];
  return all;
}

/// The sampled points of all ranks stand before the own points, so that the sums need room for the former
/// only. An own sampled leaf acts on itself by its copy, whose pairs of a point with itself the kernel knows.
void DistributedSample::sum_directly(const DistributedTreeField& pieces, const Spread& all, Isa isa,
                                     Threads threads) {
  const int leaf = pieces.shape().leaf, sampled = leaf * static_cast<int>(all.leaves.size());
  const int n = pieces.own_points();
  const CellPoints own = pieces.points();
  std::vector<double> r[3], q(index(sampled));
  q.insert(q.end(), own.q, own.q + n);
  for (std::size_t e = 0; e < 3; ++e) {
    r[e].resize(index(sampled));
    r[e].insert(r[e].end(), own.r[e], own.r[e] + n);
  }
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const Rows points = pieces.leaf_points(leaves_[k]);
    const auto at = index(first_ + static_cast<int>(k) * leaf), from = index(sampled + points.first);
    for (auto* values : {&r[0], &r[1], &r[2], &q})
      std::copy_n(values->begin() + static_cast<std::ptrdiff_t>(from), points.size(),
                  values->begin() + static_cast<std::ptrdiff_t>(at));
  }
  std::vector<int> borders;
  for (int b : all.borders) borders.push_back(b * leaf);
  double* const columns[] = {r[0].data(), r[1].data(), r[2].data()};
  ranks_.gather(columns, borders);

  std::vector<double> sums(3 * index(sampled));
  double* const E[3] = {sums.data(), sums.data() + sampled, sums.data() + 2 * sampled};
  for_each_task(threads, static_cast<int>(all.leaves.size()), [&](int s) {
    const CellPoints target = {{r[0].data(), r[1].data(), r[2].data()}, q.data(), s * leaf, leaf};
    const int k = s - first_ / leaf;
    if (k < 0 || k >= static_cast<int>(leaves_.size())) {
      const CellRange everything = {sampled, sampled + n};
      return wide_kernels(isa).p2p(target, &everything, 1, E);
    }
    const Rows same = pieces.leaf_points(leaves_[index(k)]);
    const CellRange sources[] = {{target.first, target.first + same.size()},
                                 {sampled, sampled + same.first},
                                 {sampled + same.last, sampled + n}};
    CellPoints own_target = target;
    own_target.count = same.size();
    wide_kernels(isa).p2p(own_target, sources, 3, E);
  });
  ranks_.sum(sums);
  for (std::size_t e = 0; e < 3; ++e)
    direct_[e].assign(E[e] + first_, E[e] + first_ + index(leaf) * leaves_.size());
}

SampledError DistributedSample::error(DistributedTreeField& pieces, Threads threads) const {
  pieces.evaluate(leaves_, threads);
  LeafErrors errors;
  std::vector<double> squares;
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const Rows points = pieces.leaf_points(leaves_[k]);
    squares.clear();
    for (int i = points.first; i < points.last; ++i) {
      const std::size_t at = k * index(pieces.shape().leaf) + index(i - points.first);
      double square = 0;
      for (int e = 0; e < 3; ++e) square += std::pow(pieces.sums(e)[index(i)] - direct_[e][at], 2);
      squares.push_back(square);
    }
    errors.add(squares);
  }
  double sums[] = {errors.leaves, errors.sum, errors.sum_squares};
  ranks_.sum(sums);
  return LeafErrors{sums[0], sums[1], sums[2], ranks_.greatest(errors.largest)}.relative_to(mean_square_);
}

}  // namespace treejet
