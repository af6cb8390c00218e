#pragma once
/// A Coulomb sum tried on a set of charges: how well, and how fast.
///
/// Times are those of the processor on one thread, the cheapest of several, and comprise all that is redone
/// when points move. The direct sum is timed right before or after, on as many rows as tell its pace: on a
/// machine with other work, ratios of the two are steadier than either.

#include <functional>
#include <string>
#include <vector>

#include "forces/coulomb/command/field_error.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "validation/support/point_sets.hpp"

namespace treejet {

struct NamedSet {
  std::string name;
  std::function<PointSet(int)> of;  ///< n points

  static std::vector<NamedSet> all();
};

/// The jet of the paper's case 3 at t = 0.02 s, simulated with elements an eighth as long, and n points
/// spread over it evenly in the index of its beads: as unevenly in space as the beads stand.
PointSet simulated_jet(int n);

/// Processor seconds of f, the least of several runs that last long enough together.
double least_seconds(const std::function<void()>& f, double together = 0.05);

/// Seconds of the direct sum for all points.
double direct_seconds(const PointSet& set, Isa isa = default_isa());

struct CoulombTrial {
  double seconds = 0;
  FieldError error;
  Interactions interactions;
};

/// A tree of this shape.
CoulombTrial tried(const PointSet& set, const TreeShape& shape, Isa isa = default_isa());

/// The choice of the program for an accuracy.
CoulombReport chosen(const PointSet& set, const CoulombRequest& request, Isa isa = default_isa());

/// Slope of the line of least squares through (log x, log y).
double log_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace treejet
