#pragma once
/// How far the forces of a run are from exact ones, as measured by whoever approximates them
/// (forces/coulomb/solver/coulomb_solver.hpp) on a sample of beads every so often. Observables and outputs
/// read it; a scene with exact forces has none.
///
/// Errors are those of the Coulomb field against the direct sum, relative to the root mean square of the
/// field; `own` those of each bead relative to the field at the bead itself, which 99 in 100 beads stay
/// below. They are 0 while the direct sum is used.

#include <string>

#include "core/base/archive.hpp"

namespace treejet {

struct FieldErrorReport {
  double asked = 0;                    ///< what l2 may be
  double l2 = 0, max = 0;              ///< root mean square and largest over the beads of the last sample
  double worst_l2 = 0, worst_max = 0;  ///< so far
  double own = 0, worst_own = 0;       ///< of the last sample, and so far
  int samples = 0, missed = 0;         ///< samples so far, and those with l2 above `asked`
  std::string method;                  ///< how the forces are computed now, in words
  int choices = 0;                     ///< of a method so far

  void visit(Archive& state) {
    state(asked, l2, max, worst_l2, worst_max, own, worst_own, samples, missed, method, choices);
  }
};

}  // namespace treejet
