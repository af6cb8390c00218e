#include "forces/coulomb/solver/coulomb_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/tree_parameters.hpp"
#include "forces/coulomb/solver/autotune.hpp"
#include "parallel/share_rows.hpp"

namespace treejet {

namespace {

/// Field and potential of all charges that are not at the place of point i.
std::array<double, 4> without_coincident(const PointCharges<3>& points, int i) {
  std::array<double, 4> sum{};
  for (int j = 0; j < points.n; ++j) {
    double d[3], d2 = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      d[e] = points.r[e][i] - points.r[e][j];
      d2 += d[e] * d[e];
    }
    if (!(d2 > 0)) continue;
    const double potential = points.q[j] / std::sqrt(d2);
    for (std::size_t e = 0; e < 3; ++e) sum[e] += potential / d2 * d[e];
    sum[3] += potential;
  }
  return sum;
}

int repair_coincident(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
                      double* potential) {
  int coincident = 0;
  for (int i = rows.first; i < rows.last; ++i)
    if (!std::isfinite(field[0][i] + field[1][i] + field[2][i])) {
      const auto sum = without_coincident(points, i);
      for (std::size_t e = 0; e < 3; ++e) field[e][i] = sum[e];
      if (potential) potential[i] = sum[3];
      ++coincident;
    }
  return coincident;
}

}  // namespace

void require_valid(const CoulombRequest& request) {
  if (!(request.accuracy > 0)) throw InputError("coulomb accuracy must be positive");
  using namespace tree_parameters;
  const auto require = [](bool valid, const char* name, const char* range) {
    if (!valid) throw InputError(fmt::format("coulomb {} must be {}", name, range));
  };
  require(!request.order || is_order(*request.order), "order", orders);
  require(!request.opening || is_opening(*request.opening), "opening", openings);
  require(!request.leaf || is_leaf(*request.leaf), "leaf", leaf_sizes);
}

CoulombSolver::CoulombSolver(const CoulombRequest& request, Isa isa, const Ranks& ranks)
    : request_(request), isa_(isa), ranks_(ranks), tree_(isa, ranks), policy_(request.measured_every) {
  require_valid(request);
  report_.error.asked = request.accuracy;
}

void CoulombSolver::field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
                          Threads threads, double* potential) {
  decide(points, threads);
  if (report_.direct) {
    const std::array<double*, 4> columns = {field[0], field[1], field[2], potential};
    share_rows(ranks_, threads, rows, direct_block, std::span(columns).first(potential ? 4 : 3),
               [&](Rows block) {
                 if (potential)
                   coulomb_direct_with_potential(points, block, field, potential, isa_);
                 else
                   coulomb_direct<3>(points, block, field, isa_);
               });
    report_.interactions = {static_cast<std::int64_t>(rows.size()) * points.n, 0};
  } else {
    report_.interactions = tree_.evaluate(tree_.leaves_of(rows), rows, field, threads, potential);
  }
  report_.coincident = repair_coincident(points, rows, field, potential);
}

/// Leaves the tree arranged for these points, or `report_.direct` set.
void CoulombSolver::decide(const PointCharges<3>& points, Threads threads) {
  if (request_.method == CoulombMethod::direct || points.n < 2) return;
  const int n = points.n;
  if (policy_.tuning_due(n, report_.direct)) return choose(points, threads);
  if (report_.direct) return;
  const auto due = policy_.at_evaluation(n, report_.work, double(sampled_points(n)) * n);
  tree_.arrange(points, report_.shape, threads, /*keep_order*/ !due.sort);
  if (due.measurement && !keeps(points, threads)) choose(points, threads);
}

bool CoulombSolver::keeps(const PointCharges<3>& points, Threads threads) {
  CoulombSample sample(points.n, tree_, threads);
  policy_.measured(points.n);
  return keeps_accuracy(
      report_, request_, [&] { return sample.error(tree_, threads); },
      [&](double opening) { tree_.reshape(report_.shape.order, opening, threads); });
}

void CoulombReport::record(const SampledError& sampled) {
  expected_error = sampled.bound;
  error.l2 = sampled.l2;
  error.max = sampled.max;
  error.worst_l2 = std::max(error.worst_l2, error.l2);
  error.worst_max = std::max(error.worst_max, error.max);
  ++error.samples;
  error.missed += error.l2 > error.asked;
}

void CoulombSolver::choose(const PointCharges<3>& points, Threads threads) {
  const TunedShape choice = tuned_shape(points, request_, isa_, tree_, threads);
  report_.direct = choice.direct;
  report_.reason = choice.reason;
  report_.shape = choice.shape;
  report_.work = choice.work;
  report_.expected_error = report_.error.l2 = report_.error.max = 0;
  if (!choice.direct) report_.record(choice.error);
  report_.error.method = description(report_);
  ++report_.error.choices;
  policy_.chosen(points.n);
  if (!choice.direct && request_.points_move) keeps(points, threads);
}

std::string description(const CoulombReport& report) {
  const TreeShape& s = report.shape;
  if (report.direct) return fmt::format("direct sum ({})", report.reason);
  return fmt::format(
      "{} of order {}, opening {:.3g}, leaves of {}, {}, near field {}, expected error {:.2g} ({})",
      s.local ? "tree" : "tree without local expansions", s.order, s.opening, s.leaf,
      s.block > 0 ? fmt::format("space by blocks of {}", s.block) : "chain", s.single ? "single" : "double",
      report.expected_error, report.reason);
}

}  // namespace treejet
