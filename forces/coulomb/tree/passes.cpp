#include "forces/coulomb/tree/passes.hpp"

#include <algorithm>

namespace treejet {

namespace {

/// Cells a thread takes at once: leaves with all their points, and cells only moved up or down a level.
constexpr int leaves_a_task = 64, cells_a_task = 512;

}  // namespace

CellPoints leaf_points(const Cells& cells, const CellPoints& points, int leaf) {
  const Rows rows = cells.leaf_points(leaf);
  return {{points.r[0], points.r[1], points.r[2]}, points.q, rows.first, rows.size()};
}

void move_up(const WideKernels& kernels, const Cells& cells, const Expansions& expansions,
             const CellPoints& points, Threads threads) {
  const int bottom = cells.levels() - 1;
  const CellRange leaves = cells.level(bottom);
  for_each_block(threads, {0, cells.leaves()}, leaves_a_task, [&](Rows rows) {
    for (int k = rows.first; k < rows.last; ++k)
      kernels.p2m(expansions, leaves.first + k, leaf_points(cells, points, k));
  });
  for (int l = bottom - 1; l >= 0; --l) {
    const CellRange parents = cells.level(l), children = cells.level(l + 1);
    for_each_block(threads, {0, parents.last - parents.first}, cells_a_task, [&](Rows rows) {
      kernels.m2m(expansions, {parents.first + rows.first, parents.first + rows.last},
                  {children.first + 2 * rows.first, children.last});
    });
  }
}

void move_down(const WideKernels& kernels, const Cells& cells, const Expansions& expansions,
               std::span<const char> wanted, Threads threads) {
  const auto is_wanted = [&](int cell) { return wanted[static_cast<std::size_t>(cell)] != 0; };
  for (int l = 0; l + 1 < cells.levels(); ++l) {
    const CellRange parents = cells.level(l), children = cells.level(l + 1);
    for_each_block(threads, {0, parents.last - parents.first}, cells_a_task, [&](Rows rows) {
      // runs of wanted parents; a cell that is not wanted has no local series
      for (int k = rows.first; k < rows.last; ++k) {
        if (!is_wanted(parents.first + k)) continue;
        const int first = k;
        while (k < rows.last && is_wanted(parents.first + k)) ++k;
        kernels.l2l(expansions, {parents.first + first, parents.first + k},
                    {children.first + 2 * first, std::min(children.last, children.first + 2 * k)});
      }
    });
  }
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
