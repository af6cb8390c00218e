#include "forces/coulomb/distributed/solver_distributed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/tree_parameters.hpp"
#include "forces/coulomb/distributed/sample_distributed.hpp"
#include "forces/coulomb/solver/autotune.hpp"

namespace treejet {

namespace {

/// A leaf. Of subdomains of a few points a tree is no cheaper than the direct sum, and one that moves and
/// grows by a bead errs by many times the accuracy before it is measured again.
constexpr int least_points_of_a_rank = 32;

/// All pairs are near whatever the order; the moments, which nobody asks for, are short.
TreeShape all_pairs() {
  return {.order = 2, .opening = 0, .leaf = 32, .block = 0, .single = false, .local = true};
}

}  // namespace

DistributedSolver::DistributedSolver(const CoulombRequest& request, const Ranks& ranks, Isa isa)
    : request_(request), ranks_(ranks), isa_(isa), pieces_(ranks, isa), policy_(request.measured_every) {
  require_valid(request);
  report_.error.asked = request.accuracy;
}

void DistributedSolver::field(const PointCharges<3>& piece, Rows rows, const FieldArrays<3>& field,
                              Threads threads) {
  arrange(piece, threads);
  report_.interactions = pieces_.evaluate(threads);
  pieces_.give(field);
  bool finite = true;
  for (int i = rows.first; i < rows.last; ++i)
    finite = finite && std::isfinite(field[0][i] + field[1][i] + field[2][i]);
  if (ranks_.greatest(finite ? 0 : 1) > 0)
    throw NumericalError("two points are at one place, or a coordinate is not finite");
}

void DistributedSolver::arrange(const PointCharges<3>& piece, Threads threads) {
  double sums[] = {double(piece.n), cut_anew(piece.n) ? 1.0 : 0.0};
  ranks_.sum(sums);
  const int n = static_cast<int>(sums[0]);
  const bool other_pieces = sums[1] > 0;
  if (policy_.tuning_due(n, report_.direct)) return choose(piece, n, threads);
  if (report_.direct) return pieces_.arrange(piece, report_.shape, threads);
  const double sample_pairs = double(sampled_points_of_pieces) * n / ranks_.size();
  const auto due = policy_.at_evaluation(n, report_.work, sample_pairs, other_pieces);
  pieces_.arrange(piece, report_.shape, threads, /*keep_order*/ !due.sort);
  if (due.measurement && !keeps(piece, n, threads)) choose(piece, n, threads);
}

/// Whether this piece has become another one, whose leaves stand elsewhere.
bool DistributedSolver::cut_anew(int n) const {
  constexpr int few = 4;
  return std::abs(n - measured_piece_) > few && RebuildPolicy::differs_by(0.1, n, measured_piece_);
}

bool DistributedSolver::keeps(const PointCharges<3>& piece, int n, Threads threads) {
  const DistributedSample sample(pieces_, ranks_, isa_, threads);
  policy_.measured(n);
  measured_piece_ = piece.n;
  return keeps_accuracy(
      report_, request_, [&] { return sample.error(pieces_, threads); },
      [&](double opening) { pieces_.reopen(opening); });
}

void DistributedSolver::choose(const PointCharges<3>& piece, int n, Threads threads) {
  report_.work = std::numeric_limits<double>::infinity();
  report_.direct = true;
  report_.reason = "asked for";
  report_.expected_error = report_.error.l2 = report_.error.max = 0;
  if (request_.method == CoulombMethod::automatic && n < direct_below(request_.accuracy, isa_)) {
    report_.reason = "fewer points than the crossover of the table";
  } else if (request_.method != CoulombMethod::direct && n < least_points_of_a_rank * ranks_.size()) {
    report_.reason = "too few points for every rank to have a leaf";
  } else if (request_.method != CoulombMethod::direct) {
    TreeShape shape;
    shape.order = request_.order.value_or(usual_order(request_.accuracy));
    shape.opening = request_.opening.value_or(0.4);
    shape.even = !request_.opening;
    shape.leaf = request_.leaf.value_or(32);
    choose_order_of_points(piece, n, shape, threads);
    search(piece, shape, threads);
  }
  if (report_.direct) report_.shape = all_pairs();
  report_.error.method = description(report_);
  ++report_.error.choices;
  policy_.chosen(n);
  measured_piece_ = piece.n;
  pieces_ = DistributedTreeField(ranks_, isa_);  // what was seen at other shapes may have taken more room
  pieces_.arrange(piece, report_.shape, threads);
  if (!report_.direct && request_.points_move) keeps(piece, n, threads);
}

/// Chain or space: whichever needs the least work at this shape. Long pieces are looked at each by itself: in
/// an order that suits the chain ill, they would show each other nearly all they hold.
void DistributedSolver::choose_order_of_points(const PointCharges<3>& piece, int n, TreeShape& shape,
                                               Threads threads) {
  constexpr double long_piece = 4096;
  double least = std::numeric_limits<double>::infinity();
  TreeShape tried = shape;
  tried.even = false;  // as in autotune.cpp
  for (int block : {0, 16, 4, 1}) {
    if (request_.space && *request_.space != (block > 0)) continue;
    tried.block = block;
    pieces_.arrange_alone(piece, tried, threads);
    if (n < long_piece * ranks_.size()) pieces_.reopen(shape.opening);
    const double work = this->work();
    if (work < least) least = work, shape.block = block;
  }
}

/// The cheapest of a few orders, each with the widest opening that is accurate enough.
void DistributedSolver::search(const PointCharges<3>& piece, TreeShape shape, Threads threads) {
  pieces_.arrange(piece, shape, threads);
  const DistributedSample sample(pieces_, ranks_, isa_, threads);
  SampledError best;
  report_.reason = "no tree is as accurate as asked for";
  for (int order : {shape.order, shape.order + 1, shape.order - 1}) {
    if (!tree_parameters::is_order(order) || (request_.order && order != *request_.order)) continue;
    shape.order = order;
    pieces_.arrange(piece, shape, threads, true);
    const auto error = find_opening(sample, threads);
    const double work = error ? this->work() : report_.work;
    if (!(work < report_.work)) continue;
    report_.direct = false;
    report_.shape = pieces_.shape();
    report_.work = work;
    best = *error;
  }
  if (report_.direct) return;
  report_.reason =
      best.bound <= request_.accuracy ? "cheapest accurate shape" : "pinned: less accurate than asked for";
  const double n = sample.points();
  if (request_.method == CoulombMethod::automatic && report_.work > 0.9 * n * n / ranks_.size()) {
    report_.direct = true;
    report_.reason = "no tree of this accuracy would be faster";
  } else {
    report_.record(best);
  }
}

/// The error at the widest opening that is accurate enough, or at that pinned with the order. An opening much
/// narrower than that of a shape already found would cost more than the order saves, and show every rank much
/// of the other pieces.
std::optional<SampledError> DistributedSolver::find_opening(const DistributedSample& sample,
                                                            Threads threads) {
  const double narrowest = report_.direct ? narrowest_opening : 0.6 * report_.shape.opening;
  for (double opening = request_.opening.value_or(widest_opening); opening > narrowest;
       opening *= opening_step) {
    pieces_.reopen(opening);
    const SampledError error = sample.error(pieces_, threads);
    if (request_.opening && (request_.order || error.bound <= request_.accuracy)) return error;
    if (request_.opening) break;
    if (error.bound > request_.accuracy) continue;
    // if all pairs are near this is a direct sum in disguise, whose error tells nothing of the shape
    if (ranks_.greatest(double(pieces_.count().expansions)) > 0) return error;
    break;
  }
  return {};
}

/// Of an evaluation, by the rank that has most of it.
double DistributedSolver::work() {
  return ranks_.greatest(cost(pieces_.count(), pieces_.shape(), pieces_.own_points(), isa_));
}

}  // namespace treejet
