#pragma once
/// Which cells act on which: far pairs by their expansions, near pairs of leaves point by point.
///
/// The tree is walked from the root down on the side of the targets; a target cell inherits from its parent
/// the cells that were too near for the parent, opened by one level, so both sides always stand on one level.
/// A and B are far if r_A + r_B < opening * |c_A - c_B|. Each target has its own lists, in ascending order:
/// whoever works on a target needs nothing from other targets, and the sums have one order on any number of
/// threads.

#include <vector>

#include "forces/cells.hpp"

namespace treejet {

class Traversal {
 public:
  Traversal(const Cells& cells, double opening) : cells_(cells), opening2_(opening * opening) {}

  /// Walks the targets below `cell` of `level`, itself included, whose inherited cells are `candidate` (cells
  /// of the same level by their place in it). Calls far(id of target, ids of sources) for each, near(leaf,
  /// leaves) for leaves, and below(level, cell, candidates) instead of walking on at level `stop`. wanted(id)
  /// says whether a target cell is to be walked at all.
  template <class Wanted, class Far, class Near, class Below>
  void walk(int level, int cell, const std::vector<int>& candidate, int stop, Wanted&& wanted, Far&& far,
            Near&& near, Below&& below) const {
    if (level == stop) return below(level, cell, candidate);
    std::vector<int> far_cells, near_cells;
    part(level, cell, candidate, far_cells, near_cells);
    far(cells_.level(level).first + cell, far_cells);
    if (level == cells_.levels() - 1) return near(cell, near_cells);

    const CellRange next = cells_.level(level + 1);
    const std::vector<int> opened = children(near_cells, next.last - next.first);
    for (int child = 2 * cell; child < std::min(next.last - next.first, 2 * cell + 2); ++child)
      if (wanted(next.first + child)) walk(level + 1, child, opened, stop, wanted, far, near, below);
  }

 private:
  void part(int level, int cell, const std::vector<int>& candidate, std::vector<int>& far_cells,
            std::vector<int>& near_cells) const {
    far_cells.resize(candidate.size());
    near_cells.resize(candidate.size());
    const int first = cells_.level(level).first;
    const double *cx = cells_.centre(0), *cy = cells_.centre(1), *cz = cells_.centre(2), *r = cells_.radius();
    const int own = first + cell;
    const double x = cx[own], y = cy[own], z = cz[own], radius = r[own];
    std::size_t far_count = 0, near_count = 0;
    for (int k : candidate) {
      const int id = first + k;
      const double dx = cx[id] - x, dy = cy[id] - y, dz = cz[id] - z, size = r[id] + radius;
      const bool far = size * size < opening2_ * (dx * dx + dy * dy + dz * dz);
      far_cells[far_count] = id;
      near_cells[near_count] = k;
      far_count += far;
      near_count += !far;
    }
    far_cells.resize(far_count);
    near_cells.resize(near_count);
  }

  static std::vector<int> children(const std::vector<int>& cells, int count) {
    std::vector<int> all;
    all.reserve(2 * cells.size());
    for (int k : cells) {
      all.push_back(2 * k);
      if (2 * k + 1 < count) all.push_back(2 * k + 1);
    }
    return all;
  }

  const Cells& cells_;
  double opening2_;
};

}  // namespace treejet
