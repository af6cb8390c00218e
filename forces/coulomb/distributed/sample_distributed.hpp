#pragma once
/// Sampled leaves of a chain held in pieces, with the exact field at their points: each rank sums over its
/// own piece, and the sums are added up. What all ranks learn from it is the same on all of them.

#include <vector>

#include "forces/coulomb/distributed/tree_field_distributed.hpp"
#include "forces/coulomb/solver/autotune.hpp"

namespace treejet {

/// More than of an undivided chain: there are more points, ranks share the sums, and shapes are taken that
/// just pass.
constexpr int sampled_points_of_pieces = 4096;

class DistributedSample {
 public:
  /// `pieces` is arranged, in any shape. Like `error` called by all ranks.
  DistributedSample(DistributedTreeField& pieces, const Ranks& ranks, Isa isa, Threads threads);

  /// Of all pieces.
  double points() const { return points_; }

  /// Of the field in the present shape.
  SampledError error(DistributedTreeField& pieces, Threads threads) const;

 private:
  /// Sampled leaves, spread over the leaves of all pieces, and the borders between ranks among them.
  struct Spread {
    std::vector<int> leaves, borders;
  };
  Spread spread(const DistributedTreeField& pieces) const;
  void sum_directly(const DistributedTreeField& pieces, const Spread& all, Isa isa, Threads threads);

  Ranks ranks_;
  double points_ = 0;
  double mean_square_ = 0;  ///< of the field over all points but the hundredth of each piece with the largest
  std::vector<int> leaves_;  ///< the own ones
  int first_ = 0;            ///< place of their points in `direct_`, where a leaf has `leaf` places
  std::vector<double> direct_[3];
};

}  // namespace treejet
