#include "forces/multirate/multirate_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/weighted_sum.hpp"
#include "forces/multirate/field_of_charge.hpp"
#include "parallel/work_clock.hpp"

namespace treejet {

namespace {

/// Gathers the rows integrated stage by stage, and scatters them back.
template <class Array>
void gather_fast(const Array& all, Array& some) {
  some.resize(fast_region_beads, all.cols());
  some.topRows(fast_region_old) = all.topRows(fast_region_old);
  some.bottomRows(fast_region_beads - fast_region_old) = all.bottomRows(fast_region_beads - fast_region_old);
}
template <class Array>
void scatter_fast(const Array& some, Array& all) {
  all.topRows(fast_region_old) = some.topRows(fast_region_old);
  all.bottomRows(fast_region_beads - fast_region_old) = some.bottomRows(fast_region_beads - fast_region_old);
}

/// The rows of a whole jet of n beads that are not in the fast region.
Rows slow_region(Eigen::Index n) {
  return {fast_region_old, static_cast<int>(n) - (fast_region_beads - fast_region_old)};
}

}  // namespace

template <int D>
void MultirateMotion<D>::operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) {
  const Working at(Work::multirate);
  if (!history_.continuable(y.rows())) {
    full_(jet, t, y, slope);
    ++full_evaluations_;
  } else if (&jet == &fast_region_.jet) {
    continued_ends(jet, t, y, slope);
  } else if (y.rows() == history_.beads()) {
    continued(jet, t, y, slope);
  } else {
    throw FileError("the checkpoint remembers evaluations of another jet");
  }
}

template <int D>
bool MultirateMotion<D>::on_accepted_step(const Jet<D>& jet, double t, const State<D>& y,
                                          const State<D>* known, State<D>& slope) {
  const Working at(Work::multirate);
  const double since = history_.since(t);
  const bool continues = history_.continuable(y.rows());
  if (continues && since < interval_) {
    known ? continue_middle(jet, t, y, *known, slope) : continued(jet, t, y, slope);
    return !known;
  }
  // what a stage found is full where nothing is continued yet
  const bool evaluated = full_.on_accepted_step(jet, t, y, continues ? nullptr : known, slope);
  full_evaluations_ += evaluated;
  if (y.rows() + 1 >= fast_region_beads && amplifies()) {
    history_.forget();
    return evaluated;
  }
  PastEvaluation<D> now(t, full_.chain(), jet, full_.field(), slope, Q());
  if (refines_) now.state = y;
  double interval = since;
  if (continues) {
    now.set_far();
    const double error = mismatch(jet, t, y, now) * since;
    constexpr double order = 4;
    interval *= std::clamp(std::pow(aim() / std::max(error, 1e-10), 1 / order), 0.3, 1.5);
  }
  if (history_.remember(std::move(now))) interval_ = interval;
  return evaluated;
}

/// Whether short waves grow so much down the jet that nothing is to be continued: what the continuation errs
/// differs from bead to bead. N is 9 at the most in case 3, with finer elements 10 to 13 for a moment; of 200
/// random decks two rates err more than 10 times what one rate does from 12 on.
template <int D>
bool MultirateMotion<D>::amplifies() {
  constexpr double most = 9.5, calm = 8.5;  // apart: N goes up and down with each bead that is let go
  const auto [chain, rows] = full_.own_elements();
  Eigen::ArrayXd N(1);
  N[0] = short_waves_.growth(*chain, rows);
  all_.add_up(N);
  return amplifies_ = N[0] > (amplifies_ ? calm : most);
}

/// The error to hold the continuation to. A slow bead gains it over and over on its whole way, while most
/// steps err on the youngest bead only. Intervals get shorter as the fourth root of it, and more of them add
/// up: for their sum to fall with the tolerance it must fall as the power 4/3. At loose tolerances events,
/// not errors, end the steps.
template <int D>
double MultirateMotion<D>::aim() const {
  constexpr double loose = 1e-6;
  return 0.02 * std::min(1., std::cbrt(norm_.tolerance() / loose));
}

template <int D>
const FastRegion<D>* MultirateMotion<D>::fast_region(const Jet<D>& jet) {
  if (!history_.continuable(jet.size()) || all_.beads(jet) == fast_region_beads) return nullptr;
  const Working at(Work::multirate);
  follow(jet, jet.y);
  fast_region_.jet.t = jet.t;
  gather_fast(jet.slope, fast_region_.jet.slope);
  return &fast_region_;
}

template <int D>
void MultirateMotion<D>::follow(const Jet<D>& jet, const State<D>& y) {
  gather_fast(jet.mass, fast_region_.jet.mass);
  gather_fast(jet.charge, fast_region_.jet.charge);
  gather_fast(jet.volume, fast_region_.jet.volume);
  volumes_ = &all_.all_volumes(jet);
  census_ = {volumes_->size(), jet.removed, jet.born};
  gather_fast(y, fast_region_.jet.y);
  fast_region_.jet.held = jet.held;
  fast_region_.jet.last_release = jet.last_release;
  name_fast_beads(jet);
  specific_charge_ = specific_charge(fast_region_.jet, {0, fast_region_beads});
}

/// The rows of the fast region do not follow one another: each bead has its id.
template <int D>
void MultirateMotion<D>::name_fast_beads(const Jet<D>& jet) {
  Jet<D>& fast = fast_region_.jet;
  fast.removed = jet.removed;
  fast.born = jet.born;
  if (jet.id.size() > 0) return gather_fast(jet.id, fast.id);
  const std::int64_t left_out = all_.beads(jet) - fast_region_beads;
  fast.id.resize(fast_region_beads);
  for (Eigen::Index i = 0; i < fast_region_beads; ++i)
    fast.id[i] = jet.removed + 1 + i + (i < fast_region_old ? 0 : left_out);
}

/// Q q / m of some beads.
template <int D>
Eigen::ArrayXd MultirateMotion<D>::specific_charge(const Jet<D>& jet, Rows rows) const {
  const int i = rows.first, m = rows.size();
  return Q() * jet.charge.segment(i, m) / jet.mass.segment(i, m);
}

/// The slopes of all beads.
template <int D>
void MultirateMotion<D>::continued(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) {
  follow(jet, y);
  continued_ends(fast_region_.jet, t, fast_region_.jet.y, fast_region_.jet.slope);
  continue_middle(jet, t, y, fast_region_.jet.slope, slope);
}

/// The slopes of all beads from those of the fast region.
template <int D>
void MultirateMotion<D>::continue_middle(const Jet<D>& jet, double t, const State<D>& y, const State<D>& ends,
                                         State<D>& slope) const {
  slope.resize(y.rows(), y.cols());
  scatter_fast(ends, slope);
  const Rows middle = slow_region(y.rows());
  const int i = middle.first, m = middle.size();
  const Weights w = history_.weights(t);
  slope.middleRows(i, m).template leftCols<D>() =
      y.middleRows(i, m).template middleCols<D>(velocity_column<D>);
  for (int k = 0; k < history_.columns(); ++k)
    weighted_sum(nullptr, w, history_.slopes(k, i), m, slope.col(velocity_column<D> + k).data() + i);
  if (!jet.held) return;
  const Nozzle<D>& nozzle = local_.nozzle();
  const auto held = nozzle.held(jet, position<D>(y, y.rows() - 1), t);
  const Points point = y.middleRows(i, m).template leftCols<D>();
  slope.middleRows(i, m).template middleCols<D>(velocity_column<D>) +=
      field_of<D>(held.charge, held.position, point, m).colwise() * specific_charge(jet, middle);
}

/// The slopes of the fast region.
template <int D>
void MultirateMotion<D>::continued_ends(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) {
  constexpr int n = fast_region_beads;
  const int middle = history_.beads() - n;
  const Weights w = history_.weights(t);
  slope.resize(n, y.cols());
  field_.resize(n + 2, Eigen::NoChange);
  set_boundary<D>(chain_, jet, local_.nozzle(), t, y);
  chain_.volume_at_nozzle = volumes_;
  chain_.oldest = fast_region_old;
  chain_.left_out = volumes_->size() - n;
  chain_.census = census_;
  set_points<D>(chain_, jet, y, {0, n});
  set_near_beads(w, y, slope);
  for (const FastEnd& end : fast_ends(n, chain_.points())) {
    const int i = end.fast.first, left_out = i == 0 ? 0 : middle;
    set_elements<D>(chain_, jet, y, {std::max(i - 1, 0), end.fast.last});
    local_.prepare(chain_, end.fast, {1});
    local_.set_local(chain_, end.fast, slope);
    set_near_field<D>(chain_.point, chain_.point_charge, end, field_);
    field_.middleRows(i, end.fast.size()) +=
        history_.continuation(w, &PastEvaluation<D>::far, {i + left_out, end.fast.last + left_out});
  }
  const Rows slow = {fast_old, n - fast_young};
  if (jet.held) {
    // the youngest beads have the held one among their near points
    field_.middleRows(slow.first, slow.size()).setZero();
    const Vec<D> held = chain_.point.row(n).matrix().transpose();
    add_field_of<D>(chain_.point_charge[n], held, columns<D>(y), slow.last, columns<D>(field_));
    accelerate({0, n}, slope);
  } else {
    accelerate({0, slow.first}, slope);
    accelerate({slow.last, n}, slope);
  }
  if (local_.fed_element()) local_.bind_held(chain_, coulomb_on_held(w), slope);
}

/// Q times the field at the held bead: of the points near to the young end, and, continued from the youngest
/// beads along the jet, of those farther off: a polynomial in the distance s from the held bead,
///
///     E(0) = sum_a E(s_a) prod_{b != a} s_b / (s_b - s_a) .
///
/// At 32 elements' distance or more that errs by 1e-6 of itself.
template <int D>
Vec<D> MultirateMotion<D>::coulomb_on_held(const Weights& w) {
  constexpr int n = fast_region_beads, nodes = 5;
  if (!(chain_.held_mass > 0)) return Vec<D>::Zero();
  FastEnd end = fast_ends(n, chain_.points())[1];
  end.fast = {n, n + 1};
  set_near_field<D>(chain_.point, chain_.point_charge, end, field_);
  const int beads = history_.beads();
  const Points far = history_.continuation(w, &PastEvaluation<D>::far, {beads - nodes, beads});
  std::array<double, nodes> s;  // of the beads of `far`
  s[nodes - 1] = (chain_.point.row(n - 1) - chain_.point.row(n)).matrix().norm();
  for (int a = nodes - 1; a > 0; --a) s[a - 1] = s[a] + 1 / chain_.inverse_length[n - nodes + a - 1];
  Eigen::Array<double, 1, D> field = field_.row(n);
  for (int a = 0; a < nodes; ++a) {
    double weight = 1;
    for (int b = 0; b < nodes; ++b)
      if (b != a) weight *= s[b] / (s[b] - s[a]);
    field += weight * far.row(a);
  }
  return Q() * field.matrix().transpose();
}

/// The slopes of the slow beads in the fast region, but for the field of a held bead.
template <int D>
void MultirateMotion<D>::set_near_beads(const Weights& w, const State<D>& y, State<D>& slope) const {
  constexpr Rows slow = {fast_old, fast_region_beads - fast_young};
  const int middle = history_.beads() - fast_region_beads;
  slope.middleRows(slow.first, slow.size()).template leftCols<D>() =
      y.middleRows(slow.first, slow.size()).template middleCols<D>(velocity_column<D>);
  for (int k = 0; k < history_.columns(); ++k) {
    double* const to = slope.col(velocity_column<D> + k).data();
    weighted_sum(nullptr, w, history_.slopes(k, slow.first), near_points, to + slow.first);
    weighted_sum(nullptr, w, history_.slopes(k, fast_region_old + middle), near_points, to + fast_region_old);
  }
}

/// Adds what the field does to the beads of `rows` in the fast region.
template <int D>
void MultirateMotion<D>::accelerate(Rows rows, State<D>& slope) const {
  const int i = rows.first, m = rows.size();
  for (int k = 0; k < D; ++k) {
    slope.col(velocity_column<D> + k).segment(i, m) +=
        specific_charge_.segment(i, m) * field_.col(k).segment(i, m);
  }
}

template <int D>
void MultirateMotion<D>::complete(const Jet<D>& jet, double h, const State<D>& some, State<D>& next) {
  const Working at(Work::multirate);
  const Rows middle = slow_region(jet.size());
  next.resize(jet.size(), jet.y.cols());
  scatter_fast(some, next);
  drift(jet, h, middle, next);
  if (jet.held) push_by_held(jet, h, middle, next);
}

/// The slow region after a step of extrapolated slopes.
template <int D>
void MultirateMotion<D>::drift(const SolutionPoint<D>& from, double h, Rows middle, State<D>& all) const {
  const int first = middle.first, m = middle.size();
  const Weights begin = history_.weights(from.t), half = history_.weights(from.t + h / 2),
                end = history_.weights(from.t + h);
  Weights once;                                           // integrated over the step
  std::array<double, History<D>::count + 1> twice = {h};  // the velocity's part, then the slopes'
  for (std::size_t k = 0; k < once.size(); ++k) {
    once[k] = h / 6 * (begin[k] + 4 * half[k] + end[k]);
    twice[k + 1] = h * h / 6 * (begin[k] + 2 * half[k]);
  }
  for (int k = 0; k < history_.columns(); ++k) {
    const int column = velocity_column<D> + k;
    const auto slopes = history_.slopes(k, first);
    const double* const rate = from.y.col(column).data() + first;  // velocity, then stress and the rest
    weighted_sum(rate, once, slopes, m, all.col(column).data() + first);
    if (k >= D) continue;
    weighted_sum(from.y.col(k).data() + first, twice, {rate, slopes[0], slopes[1], slopes[2]}, m,
                 all.col(k).data() + first);
  }
}

/// Adds what the held bead does to the slow region in a step.
template <int D>
void MultirateMotion<D>::push_by_held(const Jet<D>& jet, double h, Rows middle, State<D>& all) const {
  const Eigen::Index i = middle.first, m = middle.size(), youngest = jet.size() - 1;
  const Nozzle<D>& nozzle = local_.nozzle();
  Points velocity = Points::Zero(m, D), way = Points::Zero(m, D);
  const auto push = [&](double t, std::array<const double*, D> point, double once, double twice) {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = point[k][youngest], point[k] += i;
    const auto held = nozzle.held(jet, r, t);
    add_field_of<D>(held.charge * once, held.position, point, m, columns<D>(velocity));
    if (twice > 0) add_field_of<D>(held.charge * twice, held.position, point, m, columns<D>(way));
  };
  const auto change =
      jet.y.template middleCols<D>(velocity_column<D>) - all.template middleCols<D>(velocity_column<D>);
  const Points half = (jet.y.template leftCols<D>() + all.template leftCols<D>()) / 2 + h / 8 * change;
  push(jet.t, columns<D>(jet.y), h / 6, h * h / 6);
  push(jet.t + h / 2, columns<D>(half), 4 * h / 6, 2 * h * h / 6);
  push(jet.t + h, columns<D>(std::as_const(all)), h / 6, 0);

  const Eigen::ArrayXd per_field = specific_charge(jet, middle);
  all.middleRows(i, m).template middleCols<D>(velocity_column<D>) += velocity.colwise() * per_field;
  all.middleRows(i, m).template leftCols<D>() += way.colwise() * per_field;
}

/// What the continuation would have given now against what is true, in the norm of the step control.
template <int D>
double MultirateMotion<D>::mismatch(const Jet<D>& jet, double t, const State<D>& y,
                                    const PastEvaluation<D>& now) const {
  const int n = static_cast<int>(y.rows());
  const Weights w = history_.weights(t);
  State<D> error(n, y.cols());
  error.template leftCols<D>().setZero();
  error.rightCols(history_.columns()) =
      history_.continuation(w, &PastEvaluation<D>::slope, {0, n}) - now.slope;
  for (const FastEnd& end : fast_ends(n, n + 1)) {
    const int i = end.fast.first, m = end.fast.size();
    const Points far = history_.continuation(w, &PastEvaluation<D>::far, end.fast) - now.far.middleRows(i, m);
    error.middleRows(i, m).template middleCols<D>(velocity_column<D>) =
        far.colwise() * specific_charge(jet, end.fast);
    error.middleRows(i, m).rightCols(history_.columns() - D).setZero();
  }
  return all_.greatest(norm_(error, y));
}

template class MultirateMotion<1>;
template class MultirateMotion<3>;

}  // namespace treejet
