#include "forces/coulomb/distributed/tree_field_distributed.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "forces/coulomb/tree/passes.hpp"
#include "forces/coulomb/tree/traversal.hpp"

namespace treejet {

namespace {

constexpr int leaves_a_task = 64;

}  // namespace

/// Targets from the own root down. A target inherits from its parent the cells that were too near for the
/// parent, opened by one level; a leaf opens what it has inherited as far as needed. Pieces differ in size,
/// so the two sides need not stand on one level.
class DistributedTreeField::Walk {
 public:
  struct Subtree {
    int level, cell;
    std::vector<int> candidates;
  };

  /// Stops above level `stop` and leaves the subtrees there to others.
  Walk(DistributedTreeField& pieces, bool only_count, int stop = -1)
      : pieces_(pieces),
        tree_(pieces.tree_),
        own_(tree_.own()),
        opening2_(pieces.shape_.opening * pieces.shape_.opening),
        only_count_(only_count),
        stop_(stop),
        lists_(index(own_.levels())) {}

  void operator()(int level, int cell, const std::vector<int>& candidates) {
    if (level == stop_) return left.push_back({level, cell, candidates});
    Lists& lists = lists_[index(level)];
    lists.far.clear();
    lists.near.clear();
    const int target = own_.level(level).first + cell;
    const bool leaf = level == own_.levels() - 1;
    part(target, leaf, candidates, lists);
    done.expansions += only_count_ ? (static_cast<std::int64_t>(lists.far.size()) + 7) / 8 * 8
                                   : static_cast<std::int64_t>(lists.far.size());
    if (!only_count_)
      pieces_.kernels_->m2l(tree_.expansions(), target, lists.far.data(), static_cast<int>(lists.far.size()));
    if (leaf) return act_near(cell, lists.near);
    const CellRange next = own_.level(level + 1);
    for (int child = 2 * cell; child < std::min(next.last - next.first, 2 * cell + 2); ++child)
      if (pieces_.wanted_[index(next.first + child)]) (*this)(level + 1, child, lists.near);
  }

  Interactions done;
  std::vector<Subtree> left;

 private:
  struct Lists {
    std::vector<int> far, near, open;
  };

  void part(int target, bool leaf, const std::vector<int>& candidates, Lists& lists) const {
    const double radius = tree_.cell(target).critical_radius;
    lists.open.assign(candidates.begin(), candidates.end());
    for (std::size_t k = 0; k < lists.open.size(); ++k) {
      const int source = lists.open[k];
      const EssentialTree::Cell& cell = tree_.cell(source);
      const double size = radius + cell.critical_radius;
      if (are_far(size, opening2_, tree_.distance2(target, source))) {
        lists.far.push_back(source);
      } else if (cell.children > 0) {
        auto& to = leaf ? lists.open : lists.near;
        for (int child = 0; child < cell.children; ++child) to.push_back(cell.child + child);
      } else {
        lists.near.push_back(source);
      }
    }
  }

  void act_near(int leaf, std::vector<int>& near) {
    const auto before = [&](int a, int b) { return tree_.cell(a).points.first < tree_.cell(b).points.first; };
    std::sort(near.begin(), near.end(), before);
    const CellPoints target = tree_.leaf(leaf);
    const std::vector<CellRange> sources = near_ranges(near, [&](int k) {
      const Rows points = tree_.cell(k).points;
      if (points.size() == 0) throw std::logic_error("a leaf asks for what is in a closed cell");
      done.pairs += std::int64_t{target.count} * points.size();
      return points;
    });
    if (only_count_) return;
    double* const E[3] = {pieces_.sums_[0].data(), pieces_.sums_[1].data(), pieces_.sums_[2].data()};
    pieces_.kernels_->p2p(target, sources.data(), static_cast<int>(sources.size()), E);
  }

  DistributedTreeField& pieces_;
  EssentialTree& tree_;
  const Cells& own_;
  double opening2_;
  bool only_count_;
  int stop_;
  std::vector<Lists> lists_;  ///< of each level
};

void DistributedTreeField::arrange_alone(const PointCharges<3>& piece, const TreeShape& shape,
                                         Threads threads, bool keep_order) {
  shape_ = shape;
  tree_.plant(piece, shape, threads, keep_order);
  for (auto& values : sums_) values.resize(index(piece.n));
}

void DistributedTreeField::reopen(double opening) {
  shape_.opening = opening;
  tree_.graft(opening);
}

Interactions DistributedTreeField::evaluate(Threads threads) {
  std::vector<int> all(index(leaves()));
  std::iota(all.begin(), all.end(), 0);
  return evaluate(all, threads);
}

Interactions DistributedTreeField::evaluate(const std::vector<int>& leaves, Threads threads) {
  if (leaves.empty()) return {};
  const Cells& own = tree_.own();
  mark_above(own, leaves, wanted_);
  const int cut = level_of_subtrees(own);
  Walk top(*this, false, cut > 0 ? cut : -1);
  top(0, 0, tree_.roots());

  std::vector<Interactions> done(top.left.size());
  for_each_task(threads, static_cast<int>(top.left.size()), [&](int t) {
    const Walk::Subtree& subtree = top.left[index(t)];
    Walk walk(*this, false);
    walk(subtree.level, subtree.cell, subtree.candidates);
    done[index(t)] = walk.done;
  });
  done.push_back(top.done);
  move_down(*kernels_, own, tree_.expansions(), wanted_, threads);
  const int bottom = own.level(own.levels() - 1).first;
  double* const E[3] = {sums_[0].data(), sums_[1].data(), sums_[2].data()};
  for_each_block(threads, {0, static_cast<int>(leaves.size())}, leaves_a_task, [&](Rows some) {
    for (int k = some.first; k < some.last; ++k)
      kernels_->l2p(tree_.expansions(), bottom + leaves[index(k)], tree_.leaf(leaves[index(k)]), E);
  });
  return total(done);
}

Interactions DistributedTreeField::count() {
  if (leaves() == 0) return {};
  wanted_.assign(index(tree_.own().size()), 1);
  Walk walk(*this, true);
  walk(0, 0, tree_.roots());
  return walk.done;
}

void DistributedTreeField::give(const FieldArrays<3>& field) const {
  for (int k = 0; k < tree_.own().points(); ++k)
    for (std::size_t e = 0; e < 3; ++e) field[e][tree_.source(k)] = sums_[e][index(k)];
}

std::int64_t DistributedTreeField::bytes() const {
  return tree_.bytes() +
         static_cast<std::int64_t>(3 * sums_[0].capacity() * sizeof(double) + wanted_.capacity());
}

}  // namespace treejet
