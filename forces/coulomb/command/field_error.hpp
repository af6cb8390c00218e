#pragma once
/// The error of a Coulomb field against direct summation: relative L2, and its distribution over the points.

#include "forces/coulomb/coulomb.hpp"
#include "parallel/threads.hpp"

namespace treejet {

struct FieldError {
  struct Quantiles {
    double median = 0, p90 = 0, p99 = 0, p999 = 0, max = 0;
  };
  int targets = 0;   ///< points compared
  double l2 = 0;     ///< rms |E - direct| / rms |direct|
  Quantiles to_own;  ///< |E - direct| / |direct| of the point itself
  Quantiles to_rms;  ///< |E - direct| / rms |direct|
};

/// All points up to 20,000; above, 2,048 points in 128 runs of 16 at places drawn by a fixed generator. The
/// size of the field, rms |direct|, is then that of E at all points: of a jet whose beads crowd at the nozzle
/// a hundredth of them holds nearly all of it, and a sample may have none of these.
FieldError field_error(const PointCharges<3>& points, const FieldArrays<3>& field, Threads threads);

}  // namespace treejet
