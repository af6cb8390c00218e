#pragma once
/// A binary tree of cells over points in a given order. Knows no physics.
///
///     level 0            0                 every cell is a run of consecutive points;
///     level 1       0         1            the leaves, all on the last level, have `leaf` points each
///     level 2     0   1     2   3          (the last one what is left). Cell k of a level has the
///     leaves     0 1 2 3   4 5 6           children 2k and 2k+1 of the next, where they exist.
///
/// Cells of all levels stand in one array, level after level. Each has a centre, the centre of |charge| of
/// its points (their mean where all charges vanish), and the radius r of a ball about it that holds them.
/// Behind these own cells stand those grafted from the subdomains of other ranks (essential_tree.hpp), in
/// trees of their own: a grafted cell need not show its children, and its leaves stand on any level.
///
/// Beside it stands a critical radius R, by which cells are told to be far from one another: A and B are if
///
///     R_A + R_B < opening * |c_A - c_B| .
///
/// With R = r that is the usual opening. But an expansion of order p about a cell of charge Q and radius r
/// errs, in the field of a like cell at the ratio u = 2 r / |c_A - c_B|, by about Q / (2r)^2 u^(p+2): much
/// more where points crowd than where they are strewn. `equalise_errors` makes all cells err alike:
///
///     R = r / u,   u^(p+2) = ((2r)^2 / Q) / (its geometric mean over the points) ,
///
/// but never so far down that the balls of far cells could fill more than `clearance` of their distance.
/// Source: Dehnen, J. Comput. Phys. 179 (2002) 27, where for the same reason the opening depends on the mass
/// of a cell.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "forces/coulomb/simd/layout.hpp"
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
  /// With the grafted ones.
  int all() const { return static_cast<int>(opened_.size()); }
  /// The cells of a level.
  CellRange level(int l) const { return {first_[index(l)], first_[index(l + 1)]}; }
  int leaves() const { return size() - first_[index(levels() - 1)]; }
  /// The cells of level l that are below cell k of a level above.
  CellRange below(int above, int k, int l) const;
  /// The level of the roots of trees of 64 leaves: enough to fill registers, few enough for a core's caches.
  int level_of_subtrees() const { return std::max(0, levels() - 1 - 6); }
  /// The points of leaf k.
  Rows leaf_points(int k) const;
  /// The points of a cell that is a leaf, own or grafted; none of a grafted cell that shows no points.
  Rows points_of(int cell) const;
  /// What takes the place of a cell that is opened: its children, or itself if it shows none.
  CellRange opened(int cell) const { return opened_[index(cell)]; }
  bool opens(int cell) const { return opened_[index(cell)].first != cell; }
  /// The own root, if there are points, and that of each grafted tree.
  const std::vector<int>& roots() const { return roots_; }

  const double* centre(int e) const { return centre_[e].data(); }
  const double* radius() const { return radius_.data(); }
  const double* critical_radius() const { return critical_.data(); }

  /// Centres and radii for points in this tree's order, the critical ones the same; `reach(points, centre)`
  /// is their largest distance from it.
  using Reach = double (*)(const CellPoints& points, const double* centre);
  void enclose(const CellPoints& points, Reach reach, Threads threads);

  /// Of log2((2r)^2 / Q) over the points of leaves that have extent and charge: the last leaf, which may hold
  /// two points close together, counts as what it holds.
  struct Spread {
    double sum = 0, points = 0;
  };
  Spread spread() const;
  static constexpr double clearance = 0.8;
  /// Critical radii by which expansions of this order err alike, among leaves of that spread.
  void equalise_errors(int order, double opening, const Spread& among, Threads threads);

  struct Grafted {
    double centre[3];
    double radius, critical_radius;
    CellRange children;  ///< empty: it shows none
    Rows points;
  };
  void reserve(std::size_t cells);
  /// Room for grafted cells, to be set; the number of the first one.
  int add(int count);
  int add_root();
  void set(int cell, const Grafted& grafted);
  /// Only the own cells stay.
  void prune();
  std::int64_t bytes() const;  ///< held

 private:
  void enclose(const CellPoints& points, Reach reach, int level, CellRange cells);
  void weigh(const CellPoints& points, int leaf);
  void weigh_children(int level, int cell);
  void resize(std::size_t cells);
  void measure(const CellPoints& points, Reach reach, int level, int cell);

  int points_ = 0, leaf_ = 0;
  std::vector<int> first_ = {0, 0};  ///< of each level, and the end
  std::vector<double> centre_[3], radius_, critical_, spread_, weight_;
  std::vector<CellRange> opened_;
  std::vector<int> roots_;
  std::vector<Rows> grafted_points_;
};

}  // namespace treejet
