#pragma once
/// Whoever computes the Coulomb field of point charges at the points themselves: directly (direct_sum.hpp),
/// or by a tree that every rank holds whole or a subdomain of (coulomb_solver.hpp). Another fast sum is
/// another class behind this interface.
///
/// All ranks call `field`, which may decide anew how to compute, from counts and never from a clock. `report`
/// tells what was decided and how well the field is known; `visit` carries what the next decisions are made
/// from through a checkpoint.

#include <string>

#include "core/base/archive.hpp"
#include "core/base/field_error_report.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/coulomb/tree/tree_field.hpp"
#include "parallel/threads.hpp"

namespace treejet {

/// The error of the field on sampled leaves, relative to the root mean square of the field over all points
/// but the hundredth with the strongest field: in a cloud a few close pairs may hold most of it, and the
/// promise is to hold for a sample without them as well.
struct SampledError {
  double l2 = 0, max = 0;  ///< root mean square and largest over the sample
  double bound = 0;        ///< upper estimate of the l2 of all points
  double own = 0;          ///< which 99 in 100 points' errors relative to their own field stay below
};

struct CoulombReport {
  bool direct = true;
  std::string reason = "asked for";  ///< why direct, or how the shape was found
  TreeShape shape;                   ///< of the tree, if not direct
  double expected_error = 0;         ///< upper estimate for all points, as last measured; 0 for direct
  double work = 0;                   ///< price of an evaluation, in direct pairs, when the shape was chosen
  FieldErrorReport error;            ///< measured on the sample
  int coincident = 0;                ///< points of the last evaluation that share their place with another
  Interactions interactions;         ///< of the last evaluation

  /// Takes in a measurement of the present shape.
  void record(const SampledError& error);

  void visit(Archive& state) {
    state(direct, reason, shape, expected_error, work, error, coincident, interactions);
  }
};

/// "tree of order 5, opening 0.42, leaves of 32, chain, near field single, expected error 8.9e-06 (cheapest
/// accurate shape)", "direct sum (asked for)".
std::string description(const CoulombReport& report);

template <int D>
class FieldSolver {
 public:
  virtual ~FieldSolver() = default;
  /// "Coulomb sum over all pairs".
  virtual std::string_view name() const { return "Coulomb sum to a stated error"; }

  /// Sets the field of `rows` of these points.
  virtual void field(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field,
                     Threads threads) = 0;
  virtual const CoulombReport& report() const = 0;
  virtual void visit(Archive& state) = 0;
};

}  // namespace treejet
