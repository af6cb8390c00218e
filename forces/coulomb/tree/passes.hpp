#pragma once
/// What goes through a tree level by level: moments up to the root, local series down to the leaves.

#include <span>

#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/tree/cells.hpp"

namespace treejet {

/// Of a multipole or local series of so many terms in memory: whole registers.
constexpr int padded(int terms) {
  return (terms + 7) / 8 * 8;
}

/// `points` in the order of the leaves, from the first one on.
CellPoints leaf_points(const Cells& cells, const CellPoints& points, int leaf);

/// P2M, M2M: the moments of all cells.
void move_up(const WideKernels& kernels, const Cells& cells, const Expansions& expansions,
             const CellPoints& points, Threads threads);

/// L2L, L2P: adds to the local series of each wanted cell that of its parent, and the field of those of the
/// leaves to the sums at their points. A cell is wanted if one of its children is.
void move_down(const WideKernels& kernels, const Cells& cells, const Expansions& expansions,
               std::span<const char> wanted, const CellPoints& points, double* const* sums, Threads threads);

/// For each cell, whether one of these leaves is below it.
void mark_above(const Cells& cells, std::span<const int> leaves, std::vector<char>& wanted);

}  // namespace treejet
