#pragma once
/// The choice of a tree's shape for given points and a given accuracy.
///
/// 1. Below the crossover of a shipped table: direct.
/// 2. The order of the points, chain or space by blocks of 16, 4 or 1: whichever needs the least work at a
///    usual shape, work being counted in a walk of the tree and priced by a shipped table. Where turns of a
///    coil lie close to one another, the chain's cells overlap and its walk finds many more near pairs.
/// 3. For a few orders p about the usual one for the accuracy: the widest opening whose measured error is
///    small enough. The cheapest of these is taken; if it is not cheaper than the direct sum: direct.
///    Openings are tried from wide to narrow in steps of 7 %: the error is a staircase of them, since whole
///    shells of leaves change from far to near.
///
/// Prices are in units of one direct pair of the same instruction set, so they depend little on the machine's
/// clock. In subdomains the price is that of the rank with the most, and fewer candidates are looked at.

#include <limits>

#include "forces/coulomb/solver/coulomb_solver.hpp"

namespace treejet {

/// The order of expansion that usually costs least.
int usual_order(double accuracy);

struct TunedShape {
  bool direct = true;
  std::string reason;
  TreeShape shape;
  SampledError error;
  double work = std::numeric_limits<double>::infinity();  ///< price of an evaluation
};

/// For `all` points, of which this rank may hold a subdomain. Leaves `tree` in any shape.
TunedShape tuned_shape(const PointCharges<3>& points, int all, const CoulombRequest& request, TreeField& tree,
                       Threads threads);

/// The number of points below which `auto` sums directly without looking further.
int direct_below(double accuracy, Isa isa);

/// The price of an evaluation, in direct pairs.
double cost(const Interactions& work, const TreeShape& shape, int points, Isa isa);

}  // namespace treejet
