#pragma once
/// The local error of a step as one number:
///
///     max over beads of ( |e_r| / L_step ,  |e_v| / (L_step + |v|) ,  |e_sigma| / (1 + |sigma|) ) ,
///
/// e the error estimate of the embedded pair, components in the maximum norm, all scaled. Position counts by
/// the element length, velocity by the bead's own speed (at least an element length per relaxation time),
/// stress by its own size (at least the modulus), so that neither the spacing nor the voltage changes what a
/// tolerance buys. A maximum, not a mean: nearly all of the error sits on the youngest bead, where an average
/// over the chain would hide it.
///
/// A step may have allowance * tolerance of it. The allowance is a choice of scale: it makes tolerance 1e-6
/// mean errors of about 1e-5 of the collector distance in the farthest bead of the paper's case 3.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vec.hpp"

namespace treejet {

constexpr double allowance = 500;

template <int D>
double error_norm(const Table<D>& e, const Table<D>& y, double l_step) {
  const auto v = y.template middleCols<D>(velocity_column<D>).abs();
  const auto sigma = y.col(stress_column<D>).abs();
  const double length = e.template leftCols<D>().abs().maxCoeff() / l_step;
  const double speed = (e.template middleCols<D>(velocity_column<D>).abs().rowwise().maxCoeff() /
                        (l_step + v.rowwise().maxCoeff()))
                           .maxCoeff();
  const double stress = (e.col(stress_column<D>).abs() / (1 + sigma)).maxCoeff();
  // a maximum would let a NaN pass
  if (!std::isfinite(e.sum())) return std::numeric_limits<double>::quiet_NaN();
  return std::max({length, speed, stress});
}

/// What error_norm may be in a step: never so much that the step follows another solution.
inline double permitted_error(double tolerance) {
  constexpr double most = 0.1;
  return std::min(allowance * tolerance, most);
}

}  // namespace treejet
