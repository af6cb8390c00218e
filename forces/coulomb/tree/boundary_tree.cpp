#include "forces/coulomb/tree/boundary_tree.hpp"

#include <algorithm>
#include <cmath>

#include "forces/coulomb/tree/traversal.hpp"

namespace treejet {

/// Both sides of a condition are rounded.
constexpr double rounding = 1 - 1e-12;

namespace {

/// How far from its centre a cell of radius 0 must be to be far from all leaves in it, times the opening.
double reach(const Ball& ball, double opening) {
  return ball.leaf_radius + opening * ball.radius;
}

}  // namespace

bool closes(const Ball& ball, const double (&centre)[3], double critical_radius, double opening) {
  double d2 = 0;
  for (int e = 0; e < 3; ++e) d2 += (ball.centre[e] - centre[e]) * (ball.centre[e] - centre[e]);
  return are_far(critical_radius + reach(ball, opening), rounding * opening * opening, d2);
}

Ball enclosing(const Ball& a, const Ball& b) {
  double d2 = 0;
  for (int e = 0; e < 3; ++e) d2 += (b.centre[e] - a.centre[e]) * (b.centre[e] - a.centre[e]);
  const double d = std::sqrt(d2);
  Ball both = a.radius >= d + b.radius ? a : b;
  if (d + a.radius > b.radius && d + b.radius > a.radius) {
    both.radius = (d + a.radius + b.radius) / 2;
    const double way = (both.radius - a.radius) / d;
    for (int e = 0; e < 3; ++e) both.centre[e] = a.centre[e] + way * (b.centre[e] - a.centre[e]);
  }
  both.leaf_radius = std::max(a.leaf_radius, b.leaf_radius);
  return both;
}

std::vector<Ball> boundary(const Cells& cells, int balls) {
  if (cells.points() == 0) return {};
  const int bottom = cells.levels() - 1;
  int level = bottom;
  while (cells.level(level).last - cells.level(level).first > balls) --level;
  const CellRange all = cells.level(level), leaves = cells.level(bottom);
  std::vector<Ball> boundary;
  for (int k = all.first; k < all.last; ++k) {
    const int below = bottom - level, first = leaves.first + ((k - all.first) << below);
    Ball& ball = boundary.emplace_back(
        Ball{{cells.centre(0)[k], cells.centre(1)[k], cells.centre(2)[k]}, cells.radius()[k], 0});
    for (int leaf = first; leaf < std::min(leaves.last, first + (1 << below)); ++leaf)
      ball.leaf_radius = std::max(ball.leaf_radius, cells.critical_radius()[leaf]);
  }
  return boundary;
}

BoundaryTree::BoundaryTree(std::span<const Ball> balls, double opening) : opening_(opening) {
  for (const Ball& ball : balls) {
    for (int e = 0; e < 3; ++e) centre_[e].push_back(ball.centre[e]);
    reach_.push_back(reach(ball, opening));
  }
}

bool BoundaryTree::closes(const double (&centre)[3], double critical_radius) const {
  const double opening2 = rounding * opening_ * opening_;
  constexpr std::size_t together = 16;  // in wide registers, without a branch
  for (std::size_t first = 0; first < reach_.size(); first += together) {
    int near = 0;
    for (std::size_t b = first; b < std::min(first + together, reach_.size()); ++b) {
      const double dx = centre_[0][b] - centre[0], dy = centre_[1][b] - centre[1],
                   dz = centre_[2][b] - centre[2];
      near += !are_far(critical_radius + reach_[b], opening2, dx * dx + dy * dy + dz * dz);
    }
    if (near > 0) return false;
  }
  return true;
}

}  // namespace treejet
