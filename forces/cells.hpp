#pragma once
/// A binary tree of cells over points in a given order. Knows no physics.
///
///     level 0            0                 every cell is a run of consecutive points;
///     level 1       0         1            the leaves, all on the last level, have `leaf` points each
///     level 2     0   1     2   3          (the last one what is left). Cell k of a level has the
///     leaves     0 1 2 3   4 5 6           children 2k and 2k+1 of the next, where they exist.
///
/// Cells of all levels stand in one array, level after level. Each has a centre, the centre of |charge| of
/// its points (their mean where all charges vanish), and the radius of a ball about it that holds them.

#include <vector>

#include "forces/expansions.hpp"
#include "parallel/threads.hpp"

namespace treejet {

class Cells {
 public:
  Cells() = default;
  Cells(int points, int leaf);

  int points() const { return points_; }
  int leaf() const { return leaf_; }
  int levels() const { return static_cast<int>(first_.size()) - 1; }
  int size() const { return first_.back(); }
  /// The cells of a level.
  CellRange level(int l) const { return {first_[index(l)], first_[index(l + 1)]}; }
  int leaves() const { return size() - first_[index(levels() - 1)]; }
  /// The points of leaf k.
  Rows leaf_points(int k) const;

  const double* centre(int e) const { return centre_[e].data(); }
  const double* radius() const { return radius_.data(); }

  /// Centres and radii for points in this tree's order; `reach(points, centre)` is their largest distance
  /// from it.
  using Reach = double (*)(const CellPoints& points, const double* centre);
  void enclose(const CellPoints& points, Reach reach, Threads threads);

 private:
  static std::size_t index(int l) { return static_cast<std::size_t>(l); }
  void weigh(const CellPoints& points, int leaf);
  void weigh_children(int level, int cell);
  void measure(const CellPoints& points, Reach reach, int level, int cell);

  int points_ = 0, leaf_ = 0;
  std::vector<int> first_;  ///< of each level, and the end
  std::vector<double> centre_[3], radius_, weight_;
};

}  // namespace treejet
