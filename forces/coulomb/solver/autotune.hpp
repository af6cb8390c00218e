#pragma once
/// The choice of a tree's shape for given points and a given accuracy.
///
/// 1. Below the crossover of a shipped table: direct.
/// 2. The order of the points, chain or space by blocks of 16, 4 or 1: whichever needs the least work at a
///    usual shape, work being counted in a walk of the tree and priced by a shipped table. Where turns of a
///    coil lie close to one another, the chain's cells overlap and its walk finds many more near pairs.
/// 3. For a few orders p about the usual one for the accuracy: the widest opening whose measured error is
///    small enough. The cheapest of these is taken; if it is not cheaper than the direct sum: direct.
///
/// Prices are in units of one direct pair of the same vector path, so they depend little on the machine's
/// clock.

#include <array>
#include <limits>
#include <span>

#include "forces/coulomb/solver/coulomb_solver.hpp"

namespace treejet {

/// So many of a long chain that the few with large errors are among them: of a coil of 1e6 points 1024 missed
/// accuracy 1e-5 by a tenth.
constexpr int sampled_points(int points) {
  return points < 200'000 ? 1024 : 4096;
}

/// `count` of all leaves, spread over the tree.
std::vector<int> sample_leaves(int all, int count);

/// The mean of E^2 over the points, the largest hundredth taken as nothing (SampledError).
double typical_square(const std::array<std::span<const double>, 3>& E);

/// The squared errors of sampled leaves, added up.
struct LeafErrors {
  double leaves = 0, sum = 0, sum_squares = 0, largest = 0;

  /// Those at the points of one leaf; what is not finite (coincident points) is passed over.
  void add(std::span<const double> squares);

  /// The bound is the mean over the sampled leaves plus two standard deviations of that mean, times a margin.
  SampledError relative_to(double mean_square) const;
};

/// The order of expansion that usually costs least.
int usual_order(double accuracy);

/// Openings are tried from wide to narrow in steps of 7 %: the error is a staircase of them, since whole
/// shells of leaves change from far to near.
constexpr double widest_opening = 0.8, narrowest_opening = 0.05, opening_step = 0.93;

/// Sampled leaves and the direct field at their points.
class CoulombSample {
 public:
  /// `tree` holds the points, in any shape.
  CoulombSample(int points, TreeField& tree, Threads threads);

  SampledError error(TreeField& tree, Threads threads);

 private:
  int n_;
  double mean_square_ = 0;  ///< of the field over all points but the hundredth with the largest
  std::vector<int> leaves_;
  std::vector<std::vector<int>> points_of_leaf_;
  std::vector<double> direct_[3], tried_[3];
};

struct TunedShape {
  bool direct = true;
  std::string reason;
  TreeShape shape;
  SampledError error;
  double work = std::numeric_limits<double>::infinity();  ///< price of an evaluation
};

/// Leaves `tree` arranged in the chosen shape.
TunedShape tuned_shape(const PointCharges<3>& points, const CoulombRequest& request, Isa isa, TreeField& tree,
                       Threads threads);

/// The number of points below which `auto` sums directly without looking further.
int direct_below(double accuracy, Isa isa);

/// The price of an evaluation, in direct pairs.
double cost(const Interactions& work, const TreeShape& shape, int points, Isa isa);

}  // namespace treejet
