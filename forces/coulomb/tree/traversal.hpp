#pragma once
/// Which cells act on which: far pairs by their expansions, near pairs of leaves point by point.
///
/// The tree is walked from the root down on the side of the targets; a target cell inherits from its parent
/// the cells that were too near for the parent, opened by one level, so both sides always stand on one level.
/// Which are far from each other, cells.hpp says. Each target has its own lists, in ascending order:
/// whoever works on a target needs nothing from other targets, and the sums have one order on any number of
/// threads.

#include <algorithm>
#include <span>
#include <vector>

#include "forces/coulomb/tree/cells.hpp"

namespace treejet {

/// Whether two cells of these critical radii, summed, and this distance, squared, are far from each other.
inline bool are_far(double radii, double opening2, double distance2) {
  return radii * radii < opening2 * distance2;
}

/// The ranges of the points of near leaves: neighbouring leaves are neighbouring points, hence one range.
/// `points_of` gives the rows of a leaf; the leaves stand in the order of their points.
template <class PointsOf>
std::vector<CellRange> near_ranges(std::span<const int> leaves, PointsOf&& points_of) {
  std::vector<CellRange> ranges;
  for (int leaf : leaves) {
    const Rows points = points_of(leaf);
    if (!ranges.empty() && ranges.back().last == points.first)
      ranges.back().last = points.last;
    else
      ranges.push_back({points.first, points.last});
  }
  return ranges;
}

/// Cells above the first level with so many are walked by one thread, the subtrees below by all.
inline int level_of_subtrees(const Cells& cells) {
  constexpr int subtrees = 64;
  int level = 0;
  while (level < cells.levels() - 1 && cells.level(level).last - cells.level(level).first < subtrees) ++level;
  return level;
}

class Traversal {
 public:
  Traversal(const Cells& cells, double opening)
      : cells_(cells), opening2_(opening * opening), lists_(index(cells.levels())) {}

  /// Walks the targets below `cell` of `level`, itself included, whose inherited cells are `candidate` (cells
  /// of the same level by their place in it). Calls far(id of target, ids of sources) for each, near(leaf,
  /// leaves) for leaves, and below(level, cell, candidates) instead of walking on at level `stop`. wanted(id)
  /// says whether a target cell is to be walked at all. One walk at a time: the lists are kept.
  template <class Wanted, class Far, class Near, class Below>
  void walk(int level, int cell, std::span<const int> candidate, int stop, Wanted&& wanted, Far&& far,
            Near&& near, Below&& below) {
    if (level == stop) return below(level, cell, candidate);
    Lists& lists = lists_[static_cast<std::size_t>(level)];
    part(level, cell, candidate, lists);
    far(cells_.level(level).first + cell, lists.far());
    if (level == cells_.levels() - 1) return near(cell, lists.near());

    const CellRange next = cells_.level(level + 1);
    const std::span<const int> opened = lists.opened(next.last - next.first);
    for (int child = 2 * cell; child < std::min(next.last - next.first, 2 * cell + 2); ++child)
      if (wanted(next.first + child)) walk(level + 1, child, opened, stop, wanted, far, near, below);
  }

 private:
  /// The lists of one target, in arrays that only grow.
  class Lists {
   public:
    void start(std::size_t most) {
      if (far_.size() < most) {
        far_.resize(most);
        near_.resize(most);
        opened_.resize(2 * most);
      }
      far_count_ = near_count_ = 0;
    }
    void add(int id, int k, bool is_far) {
      far_[far_count_] = id;
      near_[near_count_] = k;
      far_count_ += is_far;
      near_count_ += !is_far;
    }
    std::span<const int> far() const { return {far_.data(), far_count_}; }
    std::span<const int> near() const { return {near_.data(), near_count_}; }
    /// The children of the near cells, of which the next level has `count`.
    std::span<const int> opened(int count) {
      std::size_t all = 0;
      for (int k : near()) {
        opened_[all++] = 2 * k;
        opened_[all] = 2 * k + 1;
        all += 2 * k + 1 < count;
      }
      return {opened_.data(), all};
    }

   private:
    std::vector<int> far_, near_, opened_;
    std::size_t far_count_ = 0, near_count_ = 0;
  };

  void part(int level, int cell, std::span<const int> candidate, Lists& lists) const {
    const int first = cells_.level(level).first, own = first + cell;
    const double *cx = cells_.centre(0), *cy = cells_.centre(1), *cz = cells_.centre(2);
    const double* R = cells_.critical_radius();
    const double x = cx[own], y = cy[own], z = cz[own], radius = R[own];
    lists.start(candidate.size());
    for (int k : candidate) {
      const int id = first + k;
      const double dx = cx[id] - x, dy = cy[id] - y, dz = cz[id] - z, size = R[id] + radius;
      lists.add(id, k, are_far(size, opening2_, dx * dx + dy * dy + dz * dz));
    }
  }

  const Cells& cells_;
  double opening2_;
  std::vector<Lists> lists_;  ///< of each level
};

}  // namespace treejet
