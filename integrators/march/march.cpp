#include "integrators/march/march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/base/error.hpp"
#include "integrators/march/diagnosis.hpp"

namespace treejet {

namespace {
/// An event this fraction of a step off the end of the step is met by dense output, whose error there carries
/// the square of this fraction; farther off, an adaptive step is made anew to end on the event.
constexpr double dense_fraction = 0.01;

void halt_if(const std::optional<std::string>& state_check, double t) {
  if (state_check) throw NumericalError(fmt::format("at scaled time {}: {}", t, *state_check));
}
}  // namespace

template <int D>
void March<D>::evaluate(SolutionPoint<D>& point, const State<D>* known) {
  effort_.evaluations += parts_.motion.on_accepted_step(jet_, point.t, point.y, known, point.slope);
}

template <int D>
void March<D>::step(double h) {
  fast_region_ = parts_.motion.fast_region(jet_);
  if (fast_region_) {
    const Jet<D>& fast = fast_region_->jet;
    parts_.stepper.step(parts_.motion, fast, fast, h, fast_next_);
    parts_.motion.complete(jet_, h, fast_next_, next_.y);
  } else {
    parts_.stepper.step(parts_.motion, jet_, jet_, h, next_.y);
  }
  next_.t = h == piece_end_ - jet_.t ? piece_end_ : jet_.t + h;
  effort_.evaluations += parts_.stepper.evaluations();
  ++effort_.steps;
}

template <int D>
DenseOutput<D> March<D>::segment() const {
  return {jet_, next_, parts_.stepper.rows_shared};
}

/// The error of the last step in the norm of the control; 0 if the scheme does not estimate it.
template <int D>
double March<D>::error() const {
  const State<D>& e = parts_.stepper.error;
  if (e.rows() == 0) return 0;
  return parts_.decomposition.greatest(parts_.norm(e, fast_region_ ? fast_region_->jet.y : jet_.y));
}

/// All who hold a subdomain name the same bead: the one that errs most.
template <int D>
void March<D>::give_up() const {
  const State<D>& error = parts_.stepper.error;
  const Decomposition<D>& all = parts_.decomposition;
  Eigen::Index bead = 0;
  double most = 0;
  const bool of_these = next_.y.rows() == jet_.size();  // no event has changed their number since
  if (error.rows() > 0 && of_these) most = error.abs().rowwise().maxCoeff().maxCoeff(&bead);
  const bool mine = !(all.greatest(most) > most);
  const auto number_of = [&](Eigen::Index row) {
    if (jet_.size() == 0) return jet_.removed;
    return fast_region_ ? number(fast_region_->jet.id, fast_region_->jet.removed, row)
                        : all.numbers(jet_)[row];
  };
  throw NumericalError(
      fmt::format("at scaled time {}: the step has fallen below round-off because of bead number {} since "
                  "the start; likely cause: beads have met, or the tolerance is too small to be met",
                  jet_.t, static_cast<std::int64_t>(all.greatest(mine ? double(number_of(bead)) : 0))));
}

/// Steps from here to next_ until the step control is content; returns the time up to which an event may be
/// met on the extrapolated solution.
template <int D>
double March<D>::attempt(double end) {
  while (true) {
    const double longest = parts_.motion.longest_step();
    if (parts_.spacing) end = std::min(end, parts_.spacing->next(jet_.t));
    double h = std::min(parts_.control.proposal(jet_.t, end), longest);
    bool aimed = false;
    if (aims()) {
      // steps of one length up to the event
      constexpr double stretch = 1.1, steps = 4;
      const double most = std::min(stretch * h, longest), horizon = steps * most;
      const double ahead = forecast_.next_event(jet_, horizon);
      if (ahead < horizon) {
        const double n = std::max(std::ceil(ahead / most), 1.0);
        aimed = n == 1;
        h = ahead / n;
      }
      h = std::min(h, end - jet_.t);
    }
    if (!(jet_.t + h > jet_.t)) give_up();
    step(h);
    if (!parts_.control.accepts(jet_.t, h, error())) {
      ++effort_.rejected;
      continue;
    }
    return aimed ? std::min(next_.t + dense_fraction * h, end) : next_.t;
  }
}

/// Within a piece the right-hand side is smooth; the slope found at its end is that of the piece before.
template <int D>
void March<D>::begin_piece() {
  piece_begin_ = jet_.t;
  piece_end_ = parts_.motion.smooth_from(jet_.t);
  if (!(piece_end_ > jet_.t)) throw std::logic_error("a piece of time without length");
}

template <int D>
void March<D>::start() {
  effort_.begun = jet_.t;
  if (jet_.size() > 0) effort_.drawn = parts_.nozzle.drawn(jet_);
  hold_ended();
  for (auto* w : parts_.observers) w->start(jet_);
  begin_piece();
  evaluate(jet_);
  halt_if(not_finite<D>(jet_.y, jet_.slope, parts_.decomposition.before(jet_)), jet_.t);
  // a nozzle that circles far off the axis begins beyond the place where it lets a bead go
  if (parts_.nozzle.inserting() && events_.overdue(Kind::insertion, jet_) > 0) {
    settle({jet_.t, Kind::insertion});
    evaluate(jet_);
  }
  under_way_ = true;
}

/// Whether the next step, as long as it may get for an event, or its extrapolation reaches the end.
template <int D>
bool March<D>::nears(double end) const {
  constexpr double most = 1.2;
  const double free = parts_.control.proposal(jet_.t, std::numeric_limits<double>::infinity());
  return jet_.t + most * std::min(free, parts_.motion.longest_step()) >= end;
}

template <int D>
bool March<D>::to(double end) {
  if (!under_way_) start();
  while (jet_.t < end && jet_.size() > 0) {
    if (parts_.end_in_sight && nears(end)) std::exchange(parts_.end_in_sight, {})();
    if (parts_.stop_here && parts_.stop_here()) return false;
    if (jet_.t >= piece_end_) {
      begin_piece();
      parts_.control.event(EventKind::kink);
      evaluate(jet_);
    }
    const double reach = attempt(std::min(end, piece_end_));
    halt_if(state_check<D>(jet_.y, next_.y, parts_.nozzle.l_step(), parts_.decomposition.before(jet_),
                           parts_.stepper.rows_shared),
            next_.t);
    evaluate(next_, parts_.stepper.slope_at_end());
    commit(parts_.events == EventRule::step ? std::nullopt : located_event(reach));
  }
  for (auto* w : parts_.observers) w->finish(jet_);
  under_way_ = false;
  return true;
}

template <int D>
void March<D>::visit(Archive& state) {
  const auto columns = jet_.y.cols();
  parts_.decomposition.visit(jet_, state);  // first: another run may begin with it alone
  state(piece_begin_);
  if (state.reading())
    piece_end_ = parts_.motion.smooth_from(piece_begin_);  // before it reads what it remembers
  state(parts_.motion, parts_.control, forecast_, effort_, under_way_);
  if (!state.reading()) return;
  const auto n = jet_.size();
  const bool has_slopes = jet_.slope.rows() == n && jet_.slope.cols() == columns;
  if (!complete(jet_) || jet_.y.cols() != columns || (under_way_ && !has_slopes))
    throw FileError("the checkpoint's jet has beads without a mass, a charge, a volume or a velocity");
}

template <int D>
void March<D>::take_over(Archive& state, const std::function<void()>& read_beads) {
  visit(state);
  read_beads();
  for (auto* w : parts_.observers) w->start(jet_);
}

/// The event that ends this step, if any. An adaptive step with an event well inside is made anew to end
/// there.
template <int D>
std::optional<typename March<D>::Due> March<D>::located_event(double reach) {
  const double h = next_.t - jet_.t;
  auto due = events_.first(jet_, segment(), reach);
  // one that is due at the very beginning ends the step there
  if (due && aims() && due->t > jet_.t && due->t < next_.t - dense_fraction * h) {
    ++effort_.retaken;
    step(due->t - jet_.t);
    evaluate(next_, parts_.stepper.slope_at_end());
    due = events_.first(jet_, segment(), next_.t + dense_fraction * h);
  }
  return due;
}

/// Beads whose column has come to its end, but for what is `missing`, stay there. True if any had to be moved,
/// on whichever rank.
template <int D>
bool March<D>::hold_ended(double missing) {
  if (!parts_.endings.any()) return false;
  return parts_.decomposition.greatest(parts_.endings.hold(jet_.y, missing) ? 1 : 0) > 0;
}

/// Shows the watchers the solution up to the event, or the whole step, and goes there.
template <int D>
void March<D>::commit(std::optional<Due> due) {
  DenseOutput<D> segment = this->segment();
  if (due) segment.until = due->t;
  for (auto* w : parts_.observers) w->segment(jet_, segment);
  if (aims()) forecast_.segment(jet_, segment);
  const std::int64_t released = effort_.released;
  bool changed = due.has_value();
  if (due) {
    jet_.y = segment.at(due->t);  // of which the jet is the beginning
    jet_.t = due->t;
    // time has no number so near to the end as the rate is high: who was due is there
    hold_ended(due->kind == Kind::ending ? -events_.overdue(Kind::ending, jet_) : 0);
    settle(*due);
  } else {
    std::swap<SolutionPoint<D>>(jet_, next_);
    changed = hold_ended();
    if (parts_.events == EventRule::step) changed |= look_at_step_end();
  }
  changed |= refine_if_due(released);
  if (changed && jet_.size() > 0) evaluate(jet_);
}

/// Splits and merges elements, if it is time to look and any need it. The bead whose release may be the sign
/// to look has been let go after `released_before` others.
template <int D>
bool March<D>::refine_if_due(std::int64_t released_before) {
  if (!parts_.spacing || !parts_.spacing->due(jet_.t, effort_.released > released_before)) return false;
  const Refinement refinement = parts_.decomposition.refinement(jet_, *parts_.spacing);
  if (refinement.empty()) return false;
  std::vector<Jet<D>> past = parts_.motion.past(jet_);
  parts_.decomposition.refine(jet_, refinement, past);
  effort_.evaluations += parts_.motion.after_refinement(jet_, std::move(past));
  for (const RefinementPass& pass : refinement)
    (pass.kind == RefinementPass::Kind::split ? effort_.split : effort_.merged) += std::ssize(pass.rows);
  for (auto* w : parts_.observers) w->refined(jet_, refinement);
  return true;
}

/// To all who learn from events, when the jet is as watchers are to see it.
template <int D>
void March<D>::announce(EventKind kind) {
  parts_.control.event(kind);
  forecast_.event(kind, jet_);
  for (auto* w : parts_.observers) w->event(kind, jet_);
}

template <int D>
void March<D>::insertion() {
  if (under_way_) parts_.nozzle.check_timely(jet_);
  if (!jet_.held) return placement();
  parts_.nozzle.release(jet_);
  parts_.motion.after_release(jet_);
  parts_.decomposition.after_release(jet_);
  ++effort_.released;
  announce(EventKind::release);
  // fed by flow, the next one is held at once
  if (events_.is_due(Kind::insertion, jet_)) placement();
}

template <int D>
void March<D>::placement() {
  parts_.nozzle.place(jet_);
  ++effort_.placed;
  announce(EventKind::place);
}

template <int D>
void March<D>::removal() {
  if (jet_.size() == 1 && parts_.nozzle.inserting()) {
    throw NumericalError(
        fmt::format("at scaled time {}: the only bead of the jet has reached the collector before "
                    "another could be inserted; likely cause: the time step is too large",
                    jet_.t));
  }
  effort_.arrived += jet_.volume[0];
  announce(EventKind::removal);
  parts_.motion.before_removal(jet_);
  drop_first<D>(jet_);
  parts_.decomposition.after_removal(jet_);
  ++effort_.removed;
}

/// A column that has ended asks for nothing but a slope without it.
template <int D>
void March<D>::settle(const Due& due) {
  if (due.kind == Kind::insertion) insertion();
  if (due.kind == Kind::removal) removal();
  while (jet_.size() > 0) {
    if (parts_.nozzle.inserting() && events_.is_due(Kind::insertion, jet_)) {
      insertion();
    } else if (parts_.collector.removing() && events_.is_due(Kind::removal, jet_)) {
      removal();
    } else {
      break;
    }
  }
}

/// True if there was an event.
template <int D>
bool March<D>::look_at_step_end() {
  const bool inserts = parts_.nozzle.inserting() && events_.overdue(Kind::insertion, jet_) >= 0;
  const bool removes = parts_.collector.removing() && events_.overdue(Kind::removal, jet_) > 0;
  if (inserts) insertion();
  if (removes) removal();
  return inserts || removes;
}

template class March<1>;
template class March<3>;

}  // namespace treejet
