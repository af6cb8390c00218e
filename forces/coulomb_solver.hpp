#pragma once
/// The Coulomb field to a stated error.
///
///     CoulombSolver coulomb({.accuracy = 1e-5});
///     coulomb.field(points, rows, field, threads);      as often as the points move
///     coulomb.report()                                  what was chosen, and the error expected
///
/// `accuracy` is the relative L2 error of the field, sqrt(sum |E - E_direct|^2 / sum |E|^2). The shape of the
/// tree (kind, order, opening, leaf) is chosen by the program (coulomb_calibration.hpp) unless pinned.
///
/// How the promise is kept: errors are measured, not bounded, because neighbours on a chain cancel and
/// amplify every error 10 to 100 times. A shape is taken only if the errors of sampled leaves against direct
/// summation, with an allowance for the spread between leaves, stay below the accuracy. The measurement is
/// repeated every `checked_every` evaluations and when the number of points has changed by a tenth; if it
/// fails, the shape is chosen anew. If no shape is accurate enough, or none is expected to be faster, the sum
/// is direct, and the report says so.
///
/// All decisions follow from the points and the count of evaluations, never from a clock: the same calls give
/// the same bits on any number of threads and ranks.
///
/// Two points at one place: the pair is left out of both fields, and counted in the report.

#include <optional>
#include <string>

#include "forces/coulomb.hpp"
#include "forces/coulomb_tree.hpp"

namespace treejet {

enum class CoulombMethod { automatic, direct, tree };

struct CoulombRequest {
  CoulombMethod method = CoulombMethod::automatic;
  double accuracy = 1e-5;
  std::optional<int> order;       ///< 2 to 14
  std::optional<double> opening;  ///< 0 to 0.9
  std::optional<int> leaf;        ///< a multiple of 16
  std::optional<bool> space;      ///< order in space, or that of the chain
  bool local_expansions = true;   ///< false: Barnes-Hut, with the same search for opening and order
  int checked_every = 64;
};

struct CoulombReport {
  bool direct = true;
  std::string reason;         ///< why direct, or how the shape was found
  TreeShape shape;            ///< of the tree, if not direct
  double expected_error = 0;  ///< relative L2, as last measured on sampled leaves; 0 for direct
  int measurements = 0;       ///< of the error, so far
  int choices = 0;            ///< of a shape, so far
  int coincident = 0;         ///< points of the last evaluation that share their place with another
  Interactions interactions;  ///< of the last evaluation

  void visit(Archive& state) {
    state(direct, reason, shape, expected_error, measurements, choices, coincident, interactions);
  }
};

class CoulombSolver {
 public:
  /// InputError for an accuracy that is not positive or a pinned value out of range.
  explicit CoulombSolver(const CoulombRequest& request, VectorPath path = default_path(),
                         const Ranks& ranks = {});

  /// The field at `rows`, the same on all ranks.
  void field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field, Threads threads);

  const CoulombReport& report() const { return report_; }

  /// What the next decisions are made from.
  void visit(Archive& state) { state(tree_, report_, chosen_for_, since_check_, since_sort_); }

 private:
  void decide(const PointCharges<3>& points, Threads threads);
  void choose(const PointCharges<3>& points, Threads threads);
  bool due(int n) const;

  CoulombRequest request_;
  VectorPath path_;
  Ranks ranks_;
  CoulombTree tree_;
  CoulombReport report_;
  int chosen_for_ = 0, since_check_ = 0, since_sort_ = 0;
};

}  // namespace treejet
