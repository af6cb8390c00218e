#pragma once
/// The Coulomb field of charges by a tree of a given shape: what to compute, not how well (coulomb_solver.hpp
/// chooses the shape from an accuracy).
///
///     tree.arrange(points, shape, threads);          order of the points, cells, moments
///     tree.evaluate(wanted, field, threads);         the field at points of the wanted leaves
///
/// Moments go up (P2M, M2M), across to far cells (M2L), down (L2L) and out (L2P); near leaves act point by
/// point (P2P). The shape without local expansions is the treecode of Barnes and Hut: moments act on points
/// at once (M2P). A field value is computed by one thread in an order of summation that depends on the points
/// and the shape only. Source: Barnes and Hut, Nature 324 (1986) 446; Dehnen, J. Comput. Phys. 179 (2002) 27.

#include <cstdint>
#include <span>
#include <vector>

#include "core/archive.hpp"
#include "forces/cells.hpp"
#include "forces/coulomb.hpp"
#include "forces/wide_kernels.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

struct TreeShape {
  int order = 6;         ///< p of multipole.hpp, 2 to 14
  double opening = 0.4;  ///< far if r_A + r_B < opening * distance
  int leaf = 32;         ///< points of a leaf, a multiple of 16
  int block = 0;         ///< 0: the order of the chain; else space_order by blocks of that many points
  bool single = false;   ///< near field in single precision
  bool local = true;     ///< local expansions; false: Barnes-Hut
};

/// What an evaluation did: pairs of points summed directly, and expansions evaluated (M2L, or M2P with
/// Barnes-Hut).
struct Interactions {
  std::int64_t pairs = 0, expansions = 0;
};

class CoulombTree {
 public:
  explicit CoulombTree(VectorPath path = default_path(), const Ranks& ranks = {})
      : kernels_(&wide_kernels(path)), ranks_(ranks) {}

  /// With `keep_order` the order found last time serves again, if the number of points and the shape allow
  /// it: right for any points, best while they hardly move.
  void arrange(const PointCharges<3>& points, const TreeShape& shape, Threads threads,
               bool keep_order = false);
  /// The same points, another order or opening.
  void reshape(int order, double opening, Threads threads);

  /// The leaves that hold points of `rows`, and a sample of `count` leaves spread over the tree.
  std::vector<int> leaves_of(Rows rows) const;
  std::vector<int> sample_leaves(int count) const;
  /// The points of a leaf, by their place in the caller's arrays.
  std::vector<int> points_of(int leaf) const;

  /// Writes the field at the points of the given leaves (ascending) that lie in `rows`. Ranks share the
  /// leaves out; what is done is told of this rank's share.
  Interactions evaluate(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                        Threads threads);

  /// The same by direct summation.
  void evaluate_directly(const std::vector<int>& leaves, const FieldArrays<3>& field, Threads threads);
  /// What `evaluate` would do for all points, with M2L counted in full registers; no sums are done.
  Interactions count() const;

  const TreeShape& shape() const { return shape_; }

  /// What `keep_order` keeps.
  void visit(Archive& state);

 private:
  int source(int k) const { return order_.empty() ? k : order_[static_cast<std::size_t>(k)]; }
  void copy_points(const PointCharges<3>& points, Threads threads);
  void expand(int order, Threads threads);
  void move_up(Threads threads);
  std::span<const int> own_share(const std::vector<int>& leaves) const;
  void gather(const std::vector<int>& leaves);
  void give(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field, Threads threads) const;
  void move_down(Threads threads);
  Interactions local_expansions(Threads threads);
  Interactions barnes_hut(Threads threads);
  void act_near(int leaf, std::span<const int> near);
  CellPoints leaf_cell(int leaf) const;
  bool wanted(int cell) const { return wanted_[static_cast<std::size_t>(cell)]; }

  const WideKernels* kernels_;
  Ranks ranks_;
  TreeShape shape_;
  Cells cells_;
  Expansions expansions_{};
  std::vector<int> order_;
  std::vector<double> r_[3], q_, field_[3], moments_, locals_;
  std::vector<char> wanted_;
  double charge_unit_ = 1;  ///< largest |q|
};

}  // namespace treejet
