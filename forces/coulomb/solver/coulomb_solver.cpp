#include "forces/coulomb/solver/coulomb_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/tree_parameters.hpp"
#include "forces/coulomb/solver/autotune.hpp"
#include "forces/coulomb/solver/sample.hpp"
#include "parallel/share_rows.hpp"
#include "parallel/work_clock.hpp"

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

/// Of points whose coordinates all are.
void require_finite(const Ranks& subdomains, const PointCharges<3>& points, Rows rows,
                    const FieldArrays<3>& field) {
  enum { fine, field_is_not, place_is_not } found = fine;
  for (int i = 0; i < points.n; ++i)
    if (!std::isfinite(points.r[0][i] + points.r[1][i] + points.r[2][i])) found = place_is_not;
  for (int i = rows.first; i < rows.last && found == fine; ++i)
    if (!std::isfinite(field[0][i] + field[1][i] + field[2][i])) found = field_is_not;
  if (subdomains.greatest(static_cast<int>(found)) == field_is_not)
    throw NumericalError("two points are at one place");
}

/// A direct sum of subdomains: all pairs are near whatever the order; the moments, which nobody asks for, are
/// short.
TreeShape all_pairs() {
  return {.order = 2, .opening = 0, .leaf = 32, .block = 0, .single = false, .local = true, .even = true};
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

CoulombSolver::CoulombSolver(const CoulombRequest& request, Isa isa, const TreeRanks& ranks)
    : request_(request), isa_(isa), ranks_(ranks), tree_(isa, ranks), policy_(request.measured_every) {
  require_valid(request);
  report_.error.asked = request.accuracy;
  if (request.method == CoulombMethod::direct) report_.error.method = description(report_);
}

void CoulombSolver::field(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
                          Threads threads, double* potential) {
  const bool by_tree = decide(points, threads);
  const Working at(Work::evaluate);
  if (!by_tree) {
    const std::array<double*, 4> columns = {field[0], field[1], field[2], potential};
    share_rows(ranks_.sharing, threads, rows, direct_block, std::span(columns).first(potential ? 4 : 3),
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
  if (tree_.in_subdomains())
    require_finite(ranks_.subdomains, points, rows, field);
  else
    report_.coincident = repair_coincident(points, rows, field, potential);
}

/// Whether the tree, now arranged for these points, is to sum.
bool CoulombSolver::decide(const PointCharges<3>& points, Threads threads) {
  double sums[] = {double(points.n), policy_.recut(points.n) ? 1.0 : 0.0};
  ranks_.subdomains.sum(sums);
  const int all = static_cast<int>(sums[0]);
  if (request_.method != CoulombMethod::direct && all >= 2) {
    if (policy_.tuning_due(all, report_.direct)) {
      choose(points, all, threads);
    } else if (!report_.direct) {
      const double pairs =
          double(sampled_points(all, tree_.in_subdomains())) * all / ranks_.subdomains.size();
      const auto due = policy_.at_evaluation(all, report_.work, pairs, sums[1] > 0);
      tree_.arrange(points, report_.shape, threads, /*keep_order*/ !due.sort);
      if (due.measurement && !keeps(points, all, threads)) choose(points, all, threads);
    }
  }
  if (!report_.direct && all >= 2) return true;
  if (tree_.in_subdomains()) tree_.arrange(points, all_pairs(), threads);
  return tree_.in_subdomains();
}

bool CoulombSolver::keeps(const PointCharges<3>& points, int all, Threads threads) {
  const Working at(Work::tuning);
  const CoulombSample sample(tree_, threads);
  policy_.measured(all, points.n);
  return keeps_accuracy(
      report_, request_, [&] { return sample.error(tree_, threads); },
      [&](const TreeShape& shape) { tree_.reshape(shape, threads); });
}

void CoulombReport::record(const SampledError& sampled) {
  expected_error = sampled.bound;
  error.l2 = sampled.l2;
  error.max = sampled.max;
  error.worst_l2 = std::max(error.worst_l2, error.l2);
  error.worst_max = std::max(error.worst_max, error.max);
  error.own = sampled.own;
  error.worst_own = std::max(error.worst_own, error.own);
  ++error.samples;
  error.missed += error.l2 > error.asked;
}

void CoulombSolver::choose(const PointCharges<3>& points, int all, Threads threads) {
  const Working at(Work::tuning);
  const TunedShape choice = tuned_shape(points, all, request_, tree_, threads);
  report_.direct = choice.direct;
  report_.reason = choice.reason;
  report_.shape = choice.shape;
  report_.work = choice.work;
  report_.expected_error = report_.error.l2 = report_.error.max = report_.error.own = 0;
  if (!choice.direct) report_.record(choice.error);
  report_.error.method = description(report_);
  ++report_.error.choices;
  policy_.chosen(all, points.n);
  tree_ = TreeField(isa_, ranks_);  // what was seen at other shapes may have taken more room
  if (choice.direct) return;
  tree_.arrange(points, choice.shape, threads);
  if (request_.points_move) keeps(points, all, threads);
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
