#include "core/observe/step_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/observe/progress.hpp"

namespace treejet {

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
  if (begin_.y.rows() == 0) {
    if (steps_ % steps_a_sample != 1) return;
    begin_ = from;
    middle_ = to.t;
    middle_slope_ = to.slope;
    return;
  }
  if (goes_on(from, h)) {
    sum_ += error_of_two_steps(to, h);
    ++samples_;
  }
  begin_ = {};
}

/// An event or a kink between the two steps has changed beads or slopes, on one rank at least.
template <int D>
bool StepErrors<D>::goes_on(const SolutionPoint<D>& from, double h) const {
  constexpr double round_off = 1e-6;  // of a step, in a time of many steps
  if (from.t != middle_ || !(std::abs(middle_ - begin_.t - h) < round_off * h)) return false;
  const bool same = from.slope.rows() == begin_.y.rows() && (from.slope == middle_slope_).all();
  return all_.greatest(same ? 0 : 1) == 0;
}

/// Of the change of position, velocity or stress over two steps, the part that the rates do not account for.
template <int D>
double StepErrors<D>::error_of_two_steps(const SolutionPoint<D>& to, double h) const {
  const auto [first, last] = all_.own_rows(to.y.rows());
  constexpr std::array<std::array<Eigen::Index, 2>, 3> columns = {
      {{0, D}, {velocity_column<D>, D}, {stress_column<D>, 1}}};
  Eigen::ArrayXd sums(6);  // squares of what is unaccounted for, and of what is not
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto [column, count] = columns[static_cast<std::size_t>(k)];
    const auto own = [&, column = column, count = count, first = first, last = last](const State<D>& table) {
      return table.block(first, column, last - first, count);
    };
    // not evaluated before they are summed up: of a long jet that is two tables less
    const auto change = own(to.y) - own(begin_.y);
    const auto by_rates = h / 3 * (own(begin_.slope) + 4 * own(middle_slope_) + own(to.slope));
    sums[k] = (change - by_rates).square().sum();
    sums[3 + k] = by_rates.square().sum();
  }
  all_.add_up(sums);
  double most = 0;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (sums[3 + k] > 0) most = std::max(most, std::sqrt(sums[k] / sums[3 + k]));
  return most;
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
  if (silent_ || warned_ || !(step_error() > large || lateness() > large)) return;
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
  SolutionPoint<D> lost;  // these are rows of one rank, and of one cut
  State<D> lost_slope;
  const bool keeps = !all_.in_subdomains();
  state(keeps ? begin_ : lost, keeps ? middle_slope_ : lost_slope, middle_, steps_, samples_, sum_,
        insertion_, removal_, warned_);
}

template class StepErrors<1>;
template class StepErrors<3>;

}  // namespace treejet
