#pragma once
/// The ranges of the tree's parameters, for everyone who checks them: the deck, the command line, the solver.

namespace treejet::tree_parameters {

constexpr int least_order = 2, greatest_order = 14;
constexpr double greatest_opening = 0.9;  ///< above 0
/// A leaf is whole wide registers, and small enough for a sample of a few leaves to be a sample.
constexpr int leaf_step = 16, greatest_leaf = 1024;

constexpr bool is_order(double p) {
  return p >= least_order && p <= greatest_order;
}
constexpr bool is_opening(double opening) {
  return opening > 0 && opening <= greatest_opening;
}
constexpr bool is_leaf(double points) {
  return points >= leaf_step && points <= greatest_leaf && points == leaf_step * int(points / leaf_step);
}

/// What they are, to complete "expected ..." or "... must be".
constexpr const char* orders = "from 2 to 14";
constexpr const char* openings = "above 0 and at most 0.9";
constexpr const char* leaf_sizes = "a multiple of 16 from 16 to 1024";

}  // namespace treejet::tree_parameters
