#pragma once
/// The Coulomb field of charges by a tree of a given shape: what to compute, not how well (coulomb_solver.hpp
/// chooses the shape from an accuracy).
///
///     tree.arrange(points, shape, threads);              order of the points, cells, moments
///     tree.evaluate(leaves, rows, field, threads);       the field at points of the leaves
///
/// Moments go up (P2M, M2M), across to far cells (M2L), down (L2L) and out (L2P); near leaves act point by
/// point (P2P). The shape without local expansions is barnes_hut.hpp. A target cell's sums depend on the
/// points and the shape only, not on which other targets are wanted or who computes them: one thread does, in
/// one order. Source: Dehnen, J. Comput. Phys. 179 (2002) 27.

#include <span>
#include <vector>

#include "core/base/archive.hpp"
#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/tree/cells.hpp"
#include "forces/coulomb/tree/interactions.hpp"
#include "forces/coulomb/tree/ordered_points.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

struct TreeShape {
  int order = 6;         ///< p of multipole.hpp, 2 to 14
  double opening = 0.4;  ///< cells.hpp
  int leaf = 32;         ///< points of a leaf, a multiple of 16
  int block = 0;         ///< 0: the order of the chain; else space_order by blocks of that many points
  bool single = false;   ///< near field in single precision
  bool local = true;     ///< local expansions; false: Barnes-Hut
  bool even = true;      ///< all cells err alike (cells.hpp); false, and Barnes-Hut: the opening as it is
};

class TreeField {
 public:
  explicit TreeField(Isa isa = default_isa(), const Ranks& ranks = {})
      : kernels_(&wide_kernels(isa)), ranks_(ranks) {}

  /// With `keep_order` the order found last time serves again, if the number of points and the shape allow
  /// it: right for any points, best while they hardly move.
  void arrange(const PointCharges<3>& points, const TreeShape& shape, Threads threads,
               bool keep_order = false) {
    place(points, shape, threads, keep_order);
    expand(threads);
  }
  /// Its two parts: points and cells, which is all that `count` needs, and moments.
  void place(const PointCharges<3>& points, const TreeShape& shape, Threads threads, bool keep_order = false);
  void expand(Threads threads);
  /// The same points, another order or opening.
  void reshape(int order, double opening, Threads threads);

  int leaves() const { return cells_.leaves(); }
  /// The leaves that hold points of `rows`.
  std::vector<int> leaves_of(Rows rows) const;
  /// The points of a leaf, by their place in the caller's arrays.
  std::vector<int> points_of(int leaf) const;

  /// Writes the field, and the potential if there is a place for it, at the points of the given leaves
  /// (ascending) that lie in `rows`. With the potential the near field is in double precision. Ranks share
  /// the leaves out; what is done is told of this rank's share.
  Interactions evaluate(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                        Threads threads, double* potential = nullptr);

  /// The same by direct summation.
  void evaluate_directly(const std::vector<int>& leaves, const FieldArrays<3>& field, Threads threads);
  /// What `evaluate` would do for all points, with M2L counted in full registers; no sums are done.
  Interactions count() const;

  const TreeShape& shape() const { return shape_; }

  /// What `keep_order` keeps.
  void visit(Archive& state);

 private:
  void equalise_errors(Threads threads);
  std::span<const int> own_share(const std::vector<int>& leaves) const;
  void gather(const std::vector<int>& leaves, std::size_t sums);
  Interactions local_expansions(std::span<const int> leaves, Threads threads);
  Interactions barnes_hut(std::span<const int> leaves, Threads threads);
  void act_near(int leaf, std::span<const int> near);
  CellPoints leaf_cell(int leaf) const;
  bool wanted(int cell) const { return wanted_[static_cast<std::size_t>(cell)]; }

  const WideKernels* kernels_;
  Ranks ranks_;
  TreeShape shape_;
  Cells cells_;
  Expansions expansions_{};
  OrderedPoints points_;
  std::vector<double> history_, locals_;
  std::vector<char> wanted_;
};

}  // namespace treejet
