#include "core/observe/step_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/observe/progress.hpp"

namespace treejet {

namespace {

/// Of the change of these columns over two steps, the part that the rates do not account for.
template <class Columns>
double unaccounted(const Columns& change, const Columns& by_rates) {
  const double size = by_rates.square().sum();
  return size > 0 ? std::sqrt((change - by_rates).square().sum() / size) : 0;
}

}  // namespace

void Lateness::add(double t, double late) {
  if (count++ == 0) first = t;
  sum += late;
  last = t;
}

double Lateness::relative() const {
  return count < 2 ? 0 : sum / double(count) / ((last - first) / double(count - 1));
}

template <int D>
void StepErrors<D>::segment(const Jet<D>& jet, const DenseOutput<D>& segment) {
  see_steps(segment);
  if (events_ == EventRule::step) see_events(jet, segment);
  constexpr int enough = 20;
  if (samples_ == enough || insertion_.count == enough || removal_.count == enough)
    warn_if_large(segment.until);
}

template <int D>
void StepErrors<D>::see_steps(const DenseOutput<D>& segment) {
  const SolutionPoint<D>&from = segment.from(), &to = segment.to();
  if (segment.until < to.t) {  // an event has cut it short
    begin_ = {};
    return;
  }
  ++steps_;
  const double h = to.t - from.t;
  constexpr double round_off = 1e-6;  // of a step, in a time of many steps
  if (begin_.y.rows() == 0) {
    if (steps_ % steps_a_sample != 1) return;
    begin_ = from;
    middle_ = to.t;
    middle_slope_ = to.slope;
    return;
  }
  // an event or a kink between the two has changed beads or slopes
  const bool goes_on = from.t == middle_ && std::abs(middle_ - begin_.t - h) < round_off * h &&
                       from.slope.rows() == begin_.y.rows() && (from.slope == middle_slope_).all();
  if (goes_on) {
    const State<D> change = to.y - begin_.y;
    const State<D> by_rates = h / 3 * (begin_.slope + 4 * middle_slope_ + to.slope);
    const auto of = [&](Eigen::Index column, Eigen::Index columns) {
      return unaccounted<Eigen::ArrayXXd>(change.middleCols(column, columns),
                                          by_rates.middleCols(column, columns));
    };
    sum_ += std::max({of(0, D), of(velocity_column<D>, D), of(stress_column<D>, 1)});
    ++samples_;
  }
  begin_ = {};
}

/// At the end of a step before its events, which are found there by the same measure.
template <int D>
void StepErrors<D>::see_events(const Jet<D>& jet, const DenseOutput<D>& segment) {
  const SolutionPoint<D>&from = segment.from(), &to = segment.to();
  const auto look = [&](Lateness& lateness, double before, double after) {
    if (after >= 0 && after > before) lateness.add(to.t, after / (after - before) * (to.t - from.t));
  };
  const auto youngest = [](const State<D>& y) { return position<D>(y, y.rows() - 1); };
  if (nozzle_.inserting())
    look(insertion_, nozzle_.overdue(jet, youngest(from.y), from.t),
         nozzle_.overdue(jet, youngest(to.y), to.t));
  if (collector_.removing()) look(removal_, collector_.overdue(from.y(0, 0)), collector_.overdue(to.y(0, 0)));
}

template <int D>
double StepErrors<D>::step_error() const {
  return samples_ > 0 ? sum_ / double(samples_) : 0;
}

template <int D>
double StepErrors<D>::lateness() const {
  return std::max(insertion_.relative(), removal_.relative());
}

template <int D>
void StepErrors<D>::warn_if_large(double t) {
  constexpr double large = 1e-3;
  if (warned_ || !(step_error() > large || lateness() > large)) return;
  warned_ = true;
  warn_at(t * time_unit_,
          fmt::format("the timestep is too long for results to 0.1 %: {}; a shorter timestep, or tolerance "
                      "instead, mends it",
                      summary()));
}

template <int D>
std::string StepErrors<D>::summary() const {
  std::string text = samples_ > 0
                         ? fmt::format("fixed step: a step errs by {:.2g} of what it changes ({} samples)",
                                       step_error(), samples_)
                         : "fixed step: no two steps between events, so no estimate of their error";
  if (events_ == EventRule::step)
    text += fmt::format("; events at the ends of steps are {:.2g} of their interval late", lateness());
  return text;
}

template <int D>
std::vector<std::pair<std::string, double>> StepErrors<D>::results() const {
  return {{"step_error", step_error()}, {"samples", double(samples_)}, {"event_lateness", lateness()}};
}

template <int D>
void StepErrors<D>::visit(Archive& state) {
  state(begin_, middle_slope_, middle_, steps_, samples_, sum_, insertion_, removal_, warned_);
}

template class StepErrors<1>;
template class StepErrors<3>;

}  // namespace treejet
