#pragma once
/// The Coulomb field to a stated error.
///
///     CoulombSolver coulomb({.accuracy = 1e-5});
///     coulomb.field(points, rows, field, threads);      as often as the points move
///     coulomb.report()                                  what was chosen, and the error expected
///
/// `accuracy` is the relative L2 error of the field, sqrt(sum |E - E_direct|^2 / sum |E|^2). The shape of the
/// tree (kind, order, opening, leaf) is chosen by the program (autotune.hpp) unless pinned.
///
/// How the promise is kept: errors are measured, not bounded, because neighbours on a chain cancel and
/// amplify every error 10 to 100 times. A shape is taken only if the errors of sampled leaves against direct
/// summation, with an allowance for the spread between leaves, stay below the accuracy. A sample speaks for
/// all because cells are made to err alike (cells.hpp): with one opening for all, a few where points crowd
/// hold most of the error. The measurement is repeated when the number of points has changed by a twentieth,
/// and so often that it takes measuring_share (rebuild_policy.hpp) of the work; if it fails, the opening is
/// narrowed, or if that does not help the shape is chosen anew, as it is when the number of points has
/// changed by half. If no shape is accurate enough, or none is expected to be faster, the sum is direct, and
/// the report says so.
///
/// All decisions follow from the points, the count of evaluations and counted work, never from a clock: the
/// same calls give the same bits on any number of threads and of ranks that share the sum.
///
/// Ranks may hold a subdomain of the points each (TreeRanks): then `points` are those of the rank, accuracy
/// and error go by all of them, and all ranks learn the same figures and take the same decisions. The error
/// is measured anew also when the subdomains are other ones. A direct sum sends all points to every rank.
/// Left out: near fields in single precision, Barnes-Hut, potentials.
///
/// Two points at one place: the pair is left out of both fields, and counted in the report. In subdomains it
/// is a NumericalError, on all ranks. A coordinate that is not finite, as a step may try that is too long,
/// leaves fields that are not.

#include <optional>
#include <string>

#include "forces/coulomb/solver/field_solver.hpp"
#include "forces/coulomb/solver/rebuild_policy.hpp"
#include "forces/coulomb/tree/tree_field.hpp"

namespace treejet {

enum class CoulombMethod { automatic, direct, tree };

/// What a shape's opening may be narrowed by at a measurement, and how often, before another is looked for.
constexpr double narrowing = 0.93;
constexpr int narrowings = 4;

struct CoulombRequest {
  CoulombMethod method = CoulombMethod::automatic;
  double accuracy = 1e-5;
  std::optional<int> order = {};           ///< 2 to 14
  std::optional<double> opening = {};      ///< 0 to 0.9
  std::optional<int> leaf = {};            ///< a multiple of 16
  std::optional<bool> space = {};          ///< order in space, or that of the chain
  bool local_expansions = true;            ///< false: Barnes-Hut, with the same search for opening and order
  bool points_move = false;                ///< the accuracy is to hold between measurements
  std::optional<int> measured_every = {};  ///< evaluations; without it, as takes measuring_share of the work
};

/// InputError for an accuracy that is not positive or a pinned value out of range.
void require_valid(const CoulombRequest& request);

/// Whether the shape last reported is accurate enough still, or becomes so by double precision or a somewhat
/// narrower opening, which costs less than a search. `measure` measures the present shape, `reshape` gives
/// the tree another.
///
/// Of points that move, cells that were near become far until the next measurement, all at once where they
/// are alike: an opening must be accurate enough one step wider, too. Two points that come close to each
/// other err by rounding, which no opening lessens: a near field in single precision is given up where the
/// error is mostly that.
template <class Measure, class Reshape>
bool keeps_accuracy(CoulombReport& report, const CoulombRequest& request, Measure measure, Reshape reshape) {
  const auto tried = [&](bool single, double opening) {
    TreeShape shape = report.shape;
    shape.single = single;
    shape.opening = opening;
    reshape(shape);
    return measure();
  };
  const auto adopt = [&](bool single, double opening, const SampledError& error) {
    report.shape.single = single;
    report.shape.opening = opening;
    report.record(error);
    report.error.method = description(report);
  };
  const double first = report.shape.opening;
  double wider = 0;
  if (request.points_move && !request.opening) wider = tried(report.shape.single, first / narrowing).bound;
  report.record(tried(report.shape.single, first));
  if (report.shape.single && report.expected_error > request.accuracy) {
    const SampledError precise = tried(false, first);
    if (precise.bound < report.expected_error / 2) {
      adopt(false, first, precise);
      wider = 0;
    }
  }
  for (int k = 0; k < narrowings && !request.opening; ++k) {
    if (std::max(wider, report.expected_error) <= request.accuracy) break;
    wider = report.expected_error;
    const double opening = report.shape.opening * narrowing;
    adopt(report.shape.single, opening, tried(report.shape.single, opening));
  }
  reshape(report.shape);
  return report.expected_error <= request.accuracy || (request.order && request.opening);
}

class CoulombSolver final : public FieldSolver<3> {
 public:
  /// InputError for a request that is not valid.
  explicit CoulombSolver(const CoulombRequest& request, Isa isa = default_isa(), const TreeRanks& ranks = {});

  /// In subdomains `rows` are all points of one.
  void field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
             Threads threads) override {
    this->field(points, rows, field, threads, nullptr);
  }
  /// The field, and the potential if there is a place for it.
  void field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field, Threads threads,
             double* potential);

  /// In subdomains its interactions are those of this rank, its work that of the rank with the most.
  const CoulombReport& report() const override { return report_; }
  const TreeField& tree() const { return tree_; }

  void visit(Archive& state) override { state(tree_, report_, policy_); }

 private:
  bool decide(const PointCharges<3>& points, Threads threads);
  void choose(const PointCharges<3>& points, int all, Threads threads);
  bool keeps(const PointCharges<3>& points, int all, Threads threads);

  CoulombRequest request_;
  Isa isa_;
  TreeRanks ranks_;
  TreeField tree_;
  CoulombReport report_;
  RebuildPolicy policy_;
};

}  // namespace treejet
