#pragma once
/// Sampled leaves of a tree, with the exact field at their points: what the error of a shape is measured by.
/// The leaves are spread over those of all subdomains; ranks that share an undivided tree take turns at them.
/// Each rank sums over the points it holds, and the sums are added up. What all ranks learn from it is the
/// same on all of them.

#include <array>
#include <span>
#include <vector>

#include "forces/coulomb/solver/field_solver.hpp"

namespace treejet {

/// So many points of a long chain that the few with large errors are among them: of a coil of 1e6 points 1024
/// missed accuracy 1e-5 by a tenth. In subdomains there are always enough, since ranks share the sums and
/// shapes are taken that just pass.
constexpr int sampled_points(int points, bool in_subdomains) {
  return points < 200'000 && !in_subdomains ? 1024 : 4096;
}

class CoulombSample {
 public:
  /// `tree` is arranged, in any shape. Like `error` called by all ranks.
  CoulombSample(TreeField& tree, Threads threads);

  /// Of the field in the present shape, on the same leaves.
  SampledError error(TreeField& tree, Threads threads) const;

 private:
  /// Leaves by their place in the own tree, and the borders between ranks among them.
  struct Spread {
    std::vector<int> leaves, borders;
  };
  static Spread spread(const TreeField& tree, int points);
  void sum_directly(const TreeField& tree, const Spread& all, Threads threads);

  double mean_square_ = 0;   ///< of the field over all points but the hundredth of each rank with the largest
  std::vector<int> leaves_;  ///< the own ones
  int first_ = 0;            ///< place of the first own one among all
  std::vector<double> direct_[3];  ///< at the points of the own ones, where each has places for a full leaf
};

}  // namespace treejet
