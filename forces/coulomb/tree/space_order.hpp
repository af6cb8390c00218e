#pragma once
/// An order of points in which neighbours in the order are neighbours in space: a kd sort that keeps blocks
/// of consecutive points together.
///
/// A jet comes ordered already, along the chain; where turns of a coil lie closer than the beads along it,
/// space is the better guide. Blocks of 1 follow space alone; longer blocks keep pieces of the chain whole
/// and sort faster.

#include <vector>

#include "parallel/threads.hpp"

namespace treejet {

/// The points in the new order, for a tree with leaves of `leaf` points: boxes are cut across their longest
/// side, at the boundary of the tree's cells. `block` divides `leaf`.
std::vector<int> space_order(const double* const* r, int n, int leaf, int block, Threads threads);

}  // namespace treejet
