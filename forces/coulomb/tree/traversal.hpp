#pragma once
/// Which cells act on which: far pairs by their expansions, near pairs of leaves point by point.
///
/// The tree is walked from the root down on the side of the targets; a target cell inherits from its parent
/// the cells that were too near for the parent, opened by one level. Own cells then stand on the level of the
/// target; grafted ones need not, and a target leaf opens what it has inherited as far as it goes. Which are
/// far from each other, cells.hpp says. Each target has its own lists, in ascending order of the own cells:
/// whoever works on a target needs nothing from other targets, and the sums have one order on any number of
/// threads.

#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include "forces/coulomb/tree/cells.hpp"

namespace treejet {

/// Whether two cells of these critical radii, summed, and this distance, squared, are far from each other.
inline bool are_far(double radii, double opening2, double distance2) {
  return radii * radii < opening2 * distance2;
}

/// The ranges of the points of near leaves, in ascending order: neighbouring leaves are neighbouring points,
/// hence one range.
inline std::vector<CellRange> near_ranges(const Cells& cells, std::span<const int> leaves) {
  std::vector<CellRange> ranges;
  ranges.reserve(leaves.size());
  for (int leaf : leaves) {
    const Rows points = cells.points_of(leaf);
    if (points.size() == 0) throw std::logic_error("a leaf asks for the points of a cell that shows none");
    ranges.push_back({points.first, points.last});
  }
  const auto before = [](const CellRange& a, const CellRange& b) { return a.first < b.first; };
  if (!std::is_sorted(ranges.begin(), ranges.end(), before)) std::sort(ranges.begin(), ranges.end(), before);
  std::size_t last = 0;
  for (std::size_t k = 1; k < ranges.size(); ++k)
    if (ranges[last].last == ranges[k].first)
      ranges[last].last = ranges[k].last;
    else
      ranges[++last] = ranges[k];
  ranges.resize(std::min(ranges.size(), last + 1));
  return ranges;
}

/// Cells above the first level with so many are walked by one thread, the subtrees below, which take unlike
/// times, by all.
inline int level_of_walks(const Cells& cells, Threads threads) {
  const int subtrees = std::max(64, 16 * threads.count);
  int level = 0;
  while (level < cells.levels() - 1 && cells.level(level).last - cells.level(level).first < subtrees) ++level;
  return level;
}

class Traversal {
 public:
  Traversal(const Cells& cells, double opening)
      : cells_(cells), opening2_(opening * opening), lists_(index(cells.levels())) {}

  /// Walks the targets below `cell` of `level`, itself included, whose inherited cells are `candidate`.
  /// Calls far(target, sources) for each, near(leaf, sources) for leaves, and below(level, cell, candidates)
  /// instead of walking on at level `stop`. Targets and sources are numbers of cells; `cell` and `leaf` are
  /// places in their level. wanted(target) says whether a target is to be walked at all. One walk at a time:
  /// the lists are kept.
  template <class Wanted, class Far, class Near, class Below>
  void walk(int level, int cell, std::span<const int> candidate, int stop, Wanted&& wanted, Far&& far,
            Near&& near, Below&& below) {
    if (level == stop) return below(level, cell, candidate);
    Lists& lists = lists_[index(level)];
    const int target = cells_.level(level).first + cell;
    const bool leaf = level == cells_.levels() - 1;
    lists.start();
    part(target, candidate, lists);
    while (leaf && lists.opens(cells_)) part(target, lists.opened(cells_), lists);
    far(target, lists.far());
    if (leaf) return near(cell, lists.near());

    const CellRange next = cells_.level(level + 1);
    const std::span<const int> opened = lists.opened(cells_);
    for (int child = 2 * cell; child < std::min(next.last - next.first, 2 * cell + 2); ++child)
      if (wanted(next.first + child)) walk(level + 1, child, opened, stop, wanted, far, near, below);
  }

 private:
  /// The lists of one target, in arrays that only grow.
  class Lists {
   public:
    void start() { far_count_ = 0; }
    /// Near lists are made anew, of so many at the most; far ones go on.
    void make_room(std::size_t most) {
      if (near_.size() < most) near_.resize(most);
      if (far_.size() < far_count_ + most) far_.resize(far_count_ + most);
      near_count_ = 0;
    }
    void add(int cell, bool is_far) {
      far_[far_count_] = near_[near_count_] = cell;
      far_count_ += is_far;
      near_count_ += !is_far;
    }
    std::span<const int> far() const { return {far_.data(), far_count_}; }
    std::span<const int> near() const { return {near_.data(), near_count_}; }
    bool opens(const Cells& cells) const {
      return std::any_of(near().begin(), near().end(), [&](int cell) { return cells.opens(cell); });
    }
    /// What the near cells give when opened.
    std::span<const int> opened(const Cells& cells) {
      std::size_t all = 0;
      if (opened_.size() < 2 * near_count_) opened_.resize(2 * near_count_);
      for (int cell : near()) {
        const CellRange children = cells.opened(cell);
        opened_[all] = children.first;
        opened_[all + 1] = children.first + 1;
        all += static_cast<std::size_t>(children.last - children.first);
      }
      return {opened_.data(), all};
    }

   private:
    std::vector<int> far_, near_, opened_;
    std::size_t far_count_ = 0, near_count_ = 0;
  };

  void part(int target, std::span<const int> candidate, Lists& lists) const {
    const double *cx = cells_.centre(0), *cy = cells_.centre(1), *cz = cells_.centre(2);
    const double* R = cells_.critical_radius();
    const double x = cx[target], y = cy[target], z = cz[target], radius = R[target];
    lists.make_room(candidate.size());
    for (int k : candidate) {
      const double dx = cx[k] - x, dy = cy[k] - y, dz = cz[k] - z, size = R[k] + radius;
      lists.add(k, are_far(size, opening2_, dx * dx + dy * dy + dz * dz));
    }
  }

  const Cells& cells_;
  double opening2_;
  std::vector<Lists> lists_;  ///< of each level
};

}  // namespace treejet
