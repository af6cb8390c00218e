#include "forces/coulomb_solver.hpp"

#include <cmath>

#include "core/error.hpp"
#include "forces/coulomb_calibration.hpp"
#include "parallel/share_rows.hpp"

namespace treejet {

namespace {

/// Evaluations between two sorts of the points in space, while their number stays the same.
constexpr int sorted_every = 16;

/// The field of all charges that are not at the place of point i.
void field_without_coincident(const PointCharges<3>& points, int i, const FieldArrays<3>& field) {
  double E[3] = {};
  for (int j = 0; j < points.n; ++j) {
    double d[3], d2 = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      d[e] = points.r[e][i] - points.r[e][j];
      d2 += d[e] * d[e];
    }
    if (d2 > 0)
      for (int e = 0; e < 3; ++e) E[e] += points.q[j] * d[e] / (d2 * std::sqrt(d2));
  }
  for (std::size_t e = 0; e < 3; ++e) field[e][i] = E[e];
}

int repair_coincident(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field) {
  int coincident = 0;
  for (int i = rows.first; i < rows.last; ++i)
    if (!std::isfinite(field[0][i] + field[1][i] + field[2][i])) {
      field_without_coincident(points, i, field);
      ++coincident;
    }
  return coincident;
}

}  // namespace

CoulombSolver::CoulombSolver(const CoulombRequest& request, VectorPath path, const Ranks& ranks)
    : request_(request), path_(path), ranks_(ranks), tree_(path, ranks) {
  if (!(request.accuracy > 0)) throw InputError("coulomb accuracy must be positive");
  if (request.order && (*request.order < 2 || *request.order > 14))
    throw InputError("coulomb order must be 2 to 14");
  if (request.opening && !(*request.opening > 0 && *request.opening <= 0.9))
    throw InputError("coulomb opening must be above 0 and at most 0.9");
  if (request.leaf && (*request.leaf < 16 || *request.leaf % 16 != 0))
    throw InputError("coulomb leaf must be a multiple of 16");
}

void CoulombSolver::field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
                          Threads threads) {
  decide(points, threads);
  if (report_.direct) {
    share_rows(ranks_, threads, rows, direct_block, field,
               [&](Rows block) { coulomb_direct<3>(points, block, field, path_); });
    report_.interactions = {static_cast<std::int64_t>(rows.size()) * points.n, 0};
  } else {
    report_.interactions = tree_.evaluate(tree_.leaves_of(rows), rows, field, threads);
  }
  report_.coincident = repair_coincident(points, rows, field);
}

bool CoulombSolver::due(int n) const {
  return report_.choices == 0 || since_check_ >= request_.checked_every || 10 * std::abs(n - chosen_for_) > n;
}

/// Leaves the tree arranged for these points, or `report_.direct` set.
void CoulombSolver::decide(const PointCharges<3>& points, Threads threads) {
  if (request_.method == CoulombMethod::direct || points.n < 2) {
    report_.direct = true;
    report_.reason = "asked for";
    return;
  }
  const bool first = report_.choices == 0;
  const bool check = due(points.n);
  if (check) since_check_ = 0;
  ++since_check_;
  if (first || (check && report_.direct)) return choose(points, threads);
  if (report_.direct) return;

  const bool keep_order = !check && ++since_sort_ < sorted_every;
  if (!keep_order) since_sort_ = 0;
  tree_.arrange(points, report_.shape, threads, keep_order);
  if (!check) return;
  CoulombSample sample(points.n, tree_, threads);
  report_.expected_error = sample.error(tree_, threads);
  ++report_.measurements;
  chosen_for_ = points.n;
  if (report_.expected_error > request_.accuracy && !(request_.order && request_.opening))
    choose(points, threads);
}

void CoulombSolver::choose(const PointCharges<3>& points, Threads threads) {
  const CoulombChoice choice = coulomb_choice(points, request_, path_, tree_, threads);
  report_.direct = choice.direct;
  report_.reason = choice.reason;
  report_.shape = choice.shape;
  report_.expected_error = choice.expected_error;
  report_.measurements += choice.measurements;
  ++report_.choices;
  chosen_for_ = points.n;
  since_sort_ = 0;
}

}  // namespace treejet
