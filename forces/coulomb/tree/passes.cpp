#include "forces/coulomb/tree/passes.hpp"

#include <algorithm>

namespace treejet {

namespace {

int size(CellRange cells) {
  return cells.last - cells.first;
}

}  // namespace

CellPoints leaf_points(const Cells& cells, const CellPoints& points, int leaf) {
  const Rows rows = cells.leaf_points(leaf);
  return {{points.r[0], points.r[1], points.r[2]}, points.q, rows.first, rows.size()};
}

void move_up(const WideKernels& kernels, const Cells& cells, const Expansions& expansions,
             const CellPoints& points, Threads threads) {
  const int bottom = cells.levels() - 1, cut = cells.level_of_subtrees();
  const auto m2m = [&](int l, CellRange parents) {
    const CellRange children = cells.level(l + 1);
    const int first = children.first + 2 * (parents.first - cells.level(l).first);
    kernels.m2m(expansions, parents, {first, children.last});
  };
  for_each_task(threads, size(cells.level(cut)), [&](int subtree) {
    const CellRange leaves = cells.below(cut, subtree, bottom);
    for (int cell = leaves.first; cell < leaves.last; ++cell)
      kernels.p2m(expansions, cell, leaf_points(cells, points, cell - cells.level(bottom).first));
    for (int l = bottom - 1; l >= cut; --l) m2m(l, cells.below(cut, subtree, l));
  });
  for (int l = cut - 1; l >= 0; --l) m2m(l, cells.level(l));
}

void move_down(const WideKernels& kernels, const Cells& cells, const Expansions& expansions,
               std::span<const char> wanted, const CellPoints& points, double* const* sums, Threads threads) {
  const int bottom = cells.levels() - 1, cut = cells.level_of_subtrees();
  const auto is_wanted = [&](int cell) { return wanted[index(cell)] != 0; };
  // by runs of wanted parents; a cell that is not wanted has no local series
  const auto l2l = [&](int l, CellRange parents) {
    const CellRange above = cells.level(l), below = cells.level(l + 1);
    for (int k = parents.first; k < parents.last; ++k) {
      if (!is_wanted(k)) continue;
      const int first = k;
      while (k < parents.last && is_wanted(k)) ++k;
      kernels.l2l(expansions, {first, k},
                  {below.first + 2 * (first - above.first),
                   std::min(below.last, below.first + 2 * (k - above.first))});
    }
  };
  for (int l = 0; l < cut; ++l) l2l(l, cells.level(l));
  for_each_task(threads, size(cells.level(cut)), [&](int subtree) {
    for (int l = cut; l < bottom; ++l) l2l(l, cells.below(cut, subtree, l));
    const CellRange leaves = cells.below(cut, subtree, bottom);
    for (int cell = leaves.first; cell < leaves.last; ++cell)
      if (is_wanted(cell))
        kernels.l2p(expansions, cell, leaf_points(cells, points, cell - cells.level(bottom).first), sums);
  });
}

void mark_above(const Cells& cells, std::span<const int> leaves, std::vector<char>& wanted) {
  wanted.assign(static_cast<std::size_t>(cells.size()), 0);
  for (int leaf : leaves) wanted[index(cells.level(cells.levels() - 1).first + leaf)] = 1;
  for (int l = cells.levels() - 2; l >= 0; --l) {
    const CellRange parents = cells.level(l), children = cells.level(l + 1);
    for (int child = children.first; child < children.last; ++child)
      wanted[index(parents.first + (child - children.first) / 2)] |= wanted[index(child)];
  }
}

}  // namespace treejet
