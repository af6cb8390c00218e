#pragma once
/// The treecode of Barnes and Hut as the literature has it, kept as a plain option and as a check of the fast
/// path: each target point walks the tree by itself from the root. A cell A acts by its moments (M2P) if
///
///     r_A < opening |r - c_A| ,
///
/// else its children are looked at, and of a leaf its points, one by one. The operators are the plain ones of
/// multipole.hpp. Source: Barnes and Hut, Nature 324 (1986) 446.

#include "forces/coulomb/tree/cells.hpp"
#include "forces/coulomb/tree/interactions.hpp"

namespace treejet {

class BarnesHut {
 public:
  /// Cells over `points`, all of them in tree order, with their moments.
  BarnesHut(const Cells& cells, const Expansions& moments, const CellPoints& points, double opening)
      : cells_(cells), history_(moments), points_(points), opening2_(opening * opening) {}

  /// Sets the field at the points of a leaf and, if the expansions are made for it, the potential as well:
  /// `sums` are three or four arrays in tree order.
  Interactions act_on(int leaf, double* const* sums) const;

 private:
  struct Walker;  ///< one point on its way through the tree
  void act(int cell, Walker& walker) const;
  void act_directly(Rows near, Walker& walker) const;

  const Cells& cells_;
  const Expansions& history_;
  CellPoints points_;
  double opening2_;
};

}  // namespace treejet
