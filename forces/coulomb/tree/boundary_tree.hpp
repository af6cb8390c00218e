#pragma once
/// A few balls that hold the points of a subdomain, or of several: a boundary tree, by which another rank
/// sees what the leaves in there may ask for without knowing them.
///
/// Of a leaf B of another rank no more is known than that it lies in a ball (c, r) and that its critical
/// radius (cells.hpp) is no greater than rho. So a cell A is closed to all leaves in that ball if
///
///     R_A + rho < opening * (|c_A - c| - r) ;
///
/// then no leaf there asks for the children. Source: Warren and Salmon, Supercomputing '93.
///
/// Ranks decide by it alike without asking each other, hence arithmetic that has the same bits on any
/// processor: sums, products, quotients and square roots.

#include <span>
#include <vector>

#include "forces/coulomb/tree/cells.hpp"

namespace treejet {

struct Ball {
  double centre[3];
  double radius;
  double leaf_radius;  ///< the largest critical radius of a leaf in it
};

/// Whether no leaf in the ball can ask for what a cell of that centre and critical radius is made of.
bool closes(const Ball& ball, const double (&centre)[3], double critical_radius, double opening);

/// The smallest ball that holds both.
Ball enclosing(const Ball& a, const Ball& b);

/// Balls of the lowest level of a tree that has no more than so many cells; none without points.
std::vector<Ball> boundary(const Cells& cells, int balls);

/// Balls one after the other in memory, for many cells.
class BoundaryTree {
 public:
  BoundaryTree(std::span<const Ball> balls, double opening);

  /// Whether no leaf in any of the balls can ask for it.
  bool closes(const double (&centre)[3], double critical_radius) const;

 private:
  double opening_;
  std::vector<double> centre_[3], reach_;
};

}  // namespace treejet
