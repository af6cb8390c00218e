#pragma once
/// What a rank holds of a tree: cells, points in the order of the leaves, expansions of the cells. Behind the
/// own cells and points stand those grafted from other ranks (essential_tree.hpp), if there are subdomains.

#include "core/base/archive.hpp"
#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/tree/cells.hpp"
#include "forces/coulomb/tree/multipole.hpp"
#include "forces/coulomb/tree/ordered_points.hpp"
#include "forces/coulomb/tree/passes.hpp"

namespace treejet {

struct TreeShape {
  int order = 6;         ///< p of multipole.hpp, 2 to 14
  double opening = 0.4;  ///< cells.hpp; 0: all pairs are near
  int leaf = 32;         ///< points of a leaf, a multiple of 16
  int block = 0;         ///< 0: the order of the chain; else space_order by blocks of that many points
  bool single = false;   ///< near field in single precision
  bool local = true;     ///< local expansions; false: Barnes-Hut
  bool even = true;      ///< all cells err alike (cells.hpp); false, and Barnes-Hut: the opening as it is

  /// FileError for one that no tree has.
  void visit(Archive& state);
};

struct Tree {
  Cells cells;
  OrderedPoints points;
  int order = 2;                        ///< of the expansions
  std::vector<double> moments, locals;  ///< of all cells; of the own ones

  std::size_t moment_stride() const { return index(padded(Series::terms(order - 1))); }
  std::size_t local_stride() const { return index(padded(Series::terms(order))); }

  /// As the kernels see them.
  Expansions expansions(bool potential = false) {
    return {order,
            static_cast<int>(moment_stride()),
            static_cast<int>(local_stride()),
            {cells.centre(0), cells.centre(1), cells.centre(2)},
            moments.data(),
            locals.data(),
            potential};
  }

  CellPoints all_points() const { return points.points({0, points.all()}); }
  CellPoints leaf(int k) const { return points.points(cells.leaf_points(k)); }
};

}  // namespace treejet
