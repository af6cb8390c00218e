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
/// repeated when the number of points has changed by a twentieth, and so often that it takes 3 % of the work;
/// if it fails, the opening is narrowed, or if that does not help the shape is chosen anew, as it is when the
/// number of points has changed by half. If no shape is accurate enough, or none is expected to be faster,
/// the sum is direct, and the report says so.
///
/// All decisions follow from the points, the count of evaluations and counted work, never from a clock: the
/// same calls give the same bits on any number of threads and ranks.
///
/// Two points at one place: the pair is left out of both fields, and counted in the report.

#include <optional>
#include <string>

#include "core/force_error.hpp"
#include "forces/coulomb.hpp"
#include "forces/coulomb_tree.hpp"

namespace treejet {

enum class CoulombMethod { automatic, direct, tree };

/// Part of the work that measuring the error may take.
constexpr double measuring_share = 0.03;
/// What a shape's opening may be narrowed by at a measurement, and how often, before another is looked for.
constexpr double narrowing = 0.93;
constexpr int narrowings = 4;
/// Evaluations between two sorts of the points in space, while their number stays the same.
constexpr int sorted_every = 16;

struct CoulombRequest {
  CoulombMethod method = CoulombMethod::automatic;
  double accuracy = 1e-5;
  std::optional<int> order = {};           ///< 2 to 14
  std::optional<double> opening = {};      ///< 0 to 0.9
  std::optional<int> leaf = {};            ///< a multiple of 16
  std::optional<bool> space = {};          ///< order in space, or that of the chain
  bool local_expansions = true;            ///< false: Barnes-Hut, with the same search for opening and order
  std::optional<int> measured_every = {};  ///< evaluations; without it, as takes 3 % of the work
};

/// InputError for an accuracy that is not positive or a pinned value out of range.
void require_valid(const CoulombRequest& request);

/// The error of the field on sampled leaves, relative to the root mean square of the field over all points
/// but the hundredth with the strongest field: in a cloud a few close pairs may hold most of it, and the
/// promise is to hold for a sample without them as well.
struct SampledError {
  double l2 = 0, max = 0;  ///< root mean square and largest over the sample
  double bound = 0;        ///< upper estimate of the l2 of all points
};

struct CoulombReport {
  bool direct = true;
  std::string reason = "asked for";  ///< why direct, or how the shape was found
  TreeShape shape;                   ///< of the tree, if not direct
  double expected_error = 0;         ///< upper estimate for all points, as last measured; 0 for direct
  double work = 0;                   ///< price of an evaluation, in direct pairs, when the shape was chosen
  ForceError error;                  ///< measured on the sample
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

class CoulombSolver {
 public:
  /// InputError for a request that is not valid.
  explicit CoulombSolver(const CoulombRequest& request, VectorPath path = default_path(),
                         const Ranks& ranks = {});

  /// Sets the field of `rows`, and the potential if there is a place for it: the same on all ranks.
  void field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field, Threads threads,
             double* potential = nullptr);

  const CoulombReport& report() const { return report_; }

  /// What the next decisions are made from.
  void visit(Archive& state) {
    state(tree_, report_, chosen_for_, measured_for_, since_measurement_, since_sort_);
  }

 private:
  void decide(const PointCharges<3>& points, Threads threads);
  void choose(const PointCharges<3>& points, Threads threads);
  void measure(const PointCharges<3>& points, Threads threads);
  int measuring_interval(int n) const;

  CoulombRequest request_;
  VectorPath path_;
  Ranks ranks_;
  CoulombTree tree_;
  CoulombReport report_;
  int chosen_for_ = 0, measured_for_ = 0;  ///< points
  int since_measurement_ = 0, since_sort_ = 0;
};

}  // namespace treejet
