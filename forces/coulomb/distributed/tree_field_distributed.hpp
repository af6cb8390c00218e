#pragma once
/// The Coulomb field of a chain that is held in pieces, one a rank, by a tree of a given shape: what to
/// compute, not how well (pieces_solver.hpp chooses the shape from an accuracy).
///
///     pieces.arrange(piece, shape, threads);      the own tree and what is seen of the others
///     pieces.evaluate(threads);                   the sums at all own points
///     pieces.give(field);
///
/// The walk and the operators are those of the undivided tree (coulomb_tree.hpp): same condition for far
/// cells, same order of expansion, near pairs in double precision, hence the same accuracy. The bits depend
/// on how the chain is cut, but not on the number of threads. A piece may be empty. All ranks call what
/// exchanges: arrange, reopen.

#include <vector>

#include "forces/coulomb/distributed/essential_tree.hpp"

namespace treejet {

class DistributedTreeField {
 public:
  explicit DistributedTreeField(const Ranks& ranks, Isa isa = default_isa())
      : kernels_(&wide_kernels(isa)), tree_(ranks, isa) {}

  void arrange(const PointCharges<3>& piece, const TreeShape& shape, Threads threads,
               bool keep_order = false) {
    arrange_alone(piece, shape, threads, keep_order);
    reopen(shape.opening);
  }
  /// Sees nothing of the others.
  void arrange_alone(const PointCharges<3>& piece, const TreeShape& shape, Threads threads,
                     bool keep_order = false);
  /// The same points, another opening; 0: all pairs are near, a direct sum.
  void reopen(double opening);

  const TreeShape& shape() const { return shape_; }
  int own_points() const { return tree_.own().points(); }
  int leaves() const { return tree_.own().leaves(); }
  Rows leaf_points(int leaf) const { return tree_.own().leaf_points(leaf); }

  /// The sums at the points of these leaves (ascending), or of all.
  Interactions evaluate(const std::vector<int>& leaves, Threads threads);
  Interactions evaluate(Threads threads);
  /// What `evaluate` would do; no sums are done.
  Interactions count();

  /// The sums, in the order of the tree's points.
  const std::vector<double>& sums(int e) const { return sums_[e]; }
  /// The own points in that order, then those of others.
  CellPoints points() const { return tree_.points(); }
  /// The sums at all points, to the caller's order.
  void give(const FieldArrays<3>& field) const;

  /// The order of the own points, which later calls of `arrange` may keep.
  void visit(Archive& state) { state(tree_); }

  const EssentialTree::Traffic& traffic() const { return tree_.traffic(); }
  std::int64_t bytes() const;  ///< held: points, cells, expansions, letters, sums

 private:
  class Walk;

  const WideKernels* kernels_;
  EssentialTree tree_;
  TreeShape shape_;
  std::vector<double> sums_[3];
  std::vector<char> wanted_;
};

}  // namespace treejet
