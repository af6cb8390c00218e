#include "forces/two_rate_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/weighted_sum.hpp"

namespace treejet {

namespace {

constexpr int fast_old = 8, fast_young = 24;  ///< beads at the two ends
/// Further points whose field on the fast beads is not continued; as many as a block of the direct kernel.
constexpr int near = 16;

/// A fast end of the chain, and the points near to it.
struct End {
  Rows fast, window;
};

std::array<End, 2> ends(int beads, int points) {
  return {End{{0, fast_old}, {0, fast_old + near}},
          End{{beads - fast_young, beads}, {beads - fast_young - near, points}}};
}

/// Field at the fast beads of an end, of the points near to it.
template <int D>
void set_near_field(const typename Chain<D>::Points& point, const Eigen::ArrayXd& charge, const End& end,
                    typename Chain<D>::Points& field) {
  PointCharges<D> points{{}, charge.data() + end.window.first, end.window.size()};
  FieldArrays<D> out;
  for (int k = 0; k < D; ++k) {
    points.r[k] = point.col(k).data() + end.window.first;
    out[k] = field.col(k).data() + end.window.first;
  }
  coulomb_direct<D>(points, {end.fast.first - end.window.first, end.fast.last - end.window.first}, out);
}

/// Adds to e the field of a charge at p, at the first n of the points r.
template <int D>
TREEJET_WIDE_LOOPS void add_field_of(double charge, const Vec<D>& p, std::array<const double*, D> r,
                                     Eigen::Index n, std::array<double*, D> e) {
  std::array<double, D> source;
  for (int k = 0; k < D; ++k) source[k] = p[k];
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < n; ++i) {
    std::array<double, D> d;
    double d2 = 0;
    for (int k = 0; k < D; ++k) {
      d[k] = r[k][i] - source[k];
      d2 += d[k] * d[k];
    }
    const double w = charge / (d2 * std::sqrt(d2));
    for (int k = 0; k < D; ++k) e[k][i] += w * d[k];
  }
}

template <int D>
typename Chain<D>::Points field_of(double charge, const Vec<D>& p, const typename Chain<D>::Points& point,
                                   Eigen::Index n) {
  typename Chain<D>::Points e = Chain<D>::Points::Zero(n, D);
  add_field_of<D>(charge, p, columns<D>(point), n, columns<D>(e));
  return e;
}

/// Adds the field e of some charge at the first beads to what is remembered.
template <int D>
void add_field(Moment<D>& m, const typename Chain<D>::Points& e, const Jet<D>& jet, double Q) {
  const Eigen::Index n = e.rows();
  m.field.topRows(n) += e;
  m.slope.topRows(n).template leftCols<D>() += e.colwise() * (Q * jet.charge.head(n) / jet.mass.head(n));
}

/// Makes room for one more row at `at`.
template <class Array>
void insert_row(Array& a, Eigen::Index at) {
  const Eigen::Index n = a.rows();
  a.conservativeResize(n + 1, Eigen::NoChange);
  a.bottomRows(n - at) = a.middleRows(at, n - at).eval();
}

}  // namespace

template <int D>
bool TwoRateMotion<D>::continues(Eigen::Index beads) const {
  constexpr int worthwhile = 64;  // below, a full evaluation is as cheap
  return remembered_ == moments && beads >= worthwhile;
}

template <int D>
void TwoRateMotion<D>::operator()(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) {
  if (continues(y.rows())) return continued(jet, t, y, slope);
  full_(jet, t, y, slope);
  ++full_evaluations_;
}

template <int D>
void TwoRateMotion<D>::at_node(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) {
  specific_charge_ = full_.coulomb()->Q() * jet.charge / jet.mass;
  const double since = remembered_ > 0 ? t - past_[0].t : std::numeric_limits<double>::infinity();
  if (continues(y.rows()) && since < interval_) return continued(jet, t, y, slope);
  full_(jet, t, y, slope);
  ++full_evaluations_;
  Moment<D> now = moment(jet, t, slope);
  if (continues(y.rows())) {
    set_far(now);
    const double error = mismatch(jet, t, y, now) * since;
    // a slow bead gains this error over and over on its whole way, while most steps err on the youngest bead
    // only
    constexpr double aim = 1e-3, order = 4;
    interval_ = since * std::clamp(std::pow(aim / std::max(error, 1e-10), 1 / order), 0.3, 1.5);
  }
  remember(std::move(now));
}

/// The full evaluation just made.
template <int D>
Moment<D> TwoRateMotion<D>::moment(const Jet<D>& jet, double t, const Table<D>& slope) const {
  const Chain<D>& c = full_.chain();
  const Eigen::Index n = slope.rows(), nozzle = c.points() - 1;
  Moment<D> now{
      t,  c.point.topRows(n + 1),           c.point_charge.head(n + 1), full_.coulomb()->field().topRows(n),
      {}, slope.template rightCols<D + 1>()};
  if (jet.held) {
    const Vec<D> held = c.point.row(n).matrix().transpose();
    add_field<D>(now, field_of<D>(-c.point_charge[n], held, c.point, n), jet, full_.coulomb()->Q());
    now.point.row(n) = c.point.row(nozzle);
    now.point_charge[n] = c.point_charge[nozzle];
  }
  return now;
}

/// The parabola through the remembered values: its weights at t.
template <int D>
typename TwoRateMotion<D>::Weights TwoRateMotion<D>::weights(double t) const {
  const double t0 = past_[0].t, t1 = past_[1].t, t2 = past_[2].t;
  return {(t - t1) * (t - t2) / ((t0 - t1) * (t0 - t2)), (t - t0) * (t - t2) / ((t1 - t0) * (t1 - t2)),
          (t - t0) * (t - t1) / ((t2 - t0) * (t2 - t1))};
}

/// Rows of what the parabola gives for a table of the moments.
template <int D>
template <class Array>
auto TwoRateMotion<D>::continuation(const Weights& w, Array Moment<D>::*table, Rows rows) const {
  const auto remembered = [&](int k) { return (past_[k].*table).middleRows(rows.first, rows.size()); };
  return w[0] * remembered(0) + w[1] * remembered(1) + w[2] * remembered(2);
}

template <int D>
void TwoRateMotion<D>::continued(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) {
  const int n = static_cast<int>(y.rows());
  const Weights w = weights(t);
  slope.resize(n, Eigen::NoChange);
  field_.resize(n + 2, Eigen::NoChange);
  set_boundary<D>(chain_, jet, full_.nozzle(), t, y);

  const Rows slow{fast_old, n - fast_young};
  set_slow(w, slow, y, slope);
  for (const End& end : ends(n, chain_.points())) {
    set_points<D>(chain_, jet, y, {end.window.first, std::min(end.window.last, n)});
    set_elements<D>(chain_, jet, full_.nozzle(), t, y, {std::max(end.fast.first - 1, 0), end.fast.last});
    full_.set_local(chain_, y, end.fast, slope);
    set_near_field<D>(chain_.point, chain_.point_charge, end, field_);
    field_.middleRows(end.fast.first, end.fast.size()) += continuation(w, &Moment<D>::far, end.fast);
  }
  if (jet.held) {
    // the youngest beads have the held one among their near points
    field_.middleRows(slow.first, slow.size()).setZero();
    const Vec<D> held = chain_.point.row(n).matrix().transpose();
    add_field_of<D>(chain_.point_charge[n], held, columns<D>(y), slow.last, columns<D>(field_));
    accelerate({0, n}, slope);
  } else {
    for (const End& end : ends(n, chain_.points())) accelerate(end.fast, slope);
  }
}

/// The slopes of slow beads, but for the field of a held one.
template <int D>
void TwoRateMotion<D>::set_slow(const Weights& w, Rows slow, const Table<D>& y, Table<D>& slope) const {
  slope.middleRows(slow.first, slow.size()).template leftCols<D>() =
      y.middleRows(slow.first, slow.size()).template middleCols<D>(velocity_column<D>);
  for (int k = 0; k <= D; ++k) {
    std::array<const double*, moments> remembered;
    for (int m = 0; m < moments; ++m) remembered[m] = past_[m].slope.col(k).data() + slow.first;
    weighted_sum(nullptr, w, remembered, slow.size(), slope.col(velocity_column<D> + k).data() + slow.first);
  }
}

/// Adds what the field does to the beads of `rows`.
template <int D>
void TwoRateMotion<D>::accelerate(Rows rows, Table<D>& slope) const {
  const int i = rows.first, m = rows.size();
  for (int k = 0; k < D; ++k) {
    slope.col(velocity_column<D> + k).segment(i, m) +=
        specific_charge_.segment(i, m) * field_.col(k).segment(i, m);
  }
}

/// What the continuation would have given now against what is true, in the norm of the step control.
template <int D>
double TwoRateMotion<D>::mismatch(const Jet<D>& jet, double t, const Table<D>& y,
                                  const Moment<D>& now) const {
  const int n = static_cast<int>(y.rows());
  const Weights w = weights(t);
  Table<D> error(n, 2 * D + 1);
  error.template leftCols<D>().setZero();
  error.template rightCols<D + 1>() = continuation(w, &Moment<D>::slope, {0, n}) - now.slope;
  for (const End& end : ends(n, n + 1)) {
    const int i = end.fast.first, m = end.fast.size();
    const Points far = continuation(w, &Moment<D>::far, end.fast) - now.far.middleRows(i, m);
    error.middleRows(i, m).template middleCols<D>(velocity_column<D>) =
        far.colwise() * (full_.coulomb()->Q() * jet.charge.segment(i, m) / jet.mass.segment(i, m));
    error.middleRows(i, m).col(stress_column<D>).setZero();
  }
  return norm_(error, y);
}

template <int D>
void TwoRateMotion<D>::set_far(Moment<D>& moment) const {
  const auto n = static_cast<int>(moment.field.rows());
  moment.far.resize(n + 1, Eigen::NoChange);
  for (const End& end : ends(n, n + 1)) {
    set_near_field<D>(moment.point, moment.point_charge, end, moment.far);
    const int i = end.fast.first, m = end.fast.size();
    moment.far.middleRows(i, m) = moment.field.middleRows(i, m) - moment.far.middleRows(i, m);
  }
}

template <int D>
void TwoRateMotion<D>::remember(Moment<D>&& now) {
  // values too close in time would make the parabola amplify their own errors
  const bool replaces = remembered_ >= 2 && now.t - past_[0].t < 0.2 * (past_[0].t - past_[1].t);
  if (!replaces) {
    std::rotate(past_.begin(), past_.end() - 1, past_.end());
    remembered_ = std::min(remembered_ + 1, moments);
  }
  past_[0] = std::move(now);
  if (continues(past_[0].field.rows())) {
    for (auto& m : past_) set_far(m);
  }
}

template <int D>
void TwoRateMotion<D>::before_removal(const Jet<D>& jet) {
  for (int k = 0; k < remembered_; ++k) {
    Moment<D>& m = past_[k];
    const Vec<D> oldest = m.point.row(0).matrix().transpose();
    drop_first_row(m.point);
    drop_first_row(m.point_charge);
    drop_first_row(m.field);
    drop_first_row(m.slope);
    const Jet<D> left{jet.t, {}, jet.mass.tail(jet.size() - 1), jet.charge.tail(jet.size() - 1), false, 0};
    add_field<D>(m, field_of<D>(-jet.charge[0], oldest, m.point, m.field.rows()), left, full_.coulomb()->Q());
    if (continues(jet.size() - 1)) set_far(m);
  }
}

template <int D>
void TwoRateMotion<D>::after_release(const Jet<D>& jet) {
  const Eigen::Index youngest = jet.size() - 1;
  for (int k = 0; k < remembered_; ++k) {
    Moment<D>& m = past_[k];
    const Vec<D> p = position<D>(jet.y, youngest) + (m.t - jet.t) * velocity<D>(jet.y, youngest);
    add_field<D>(m, field_of<D>(jet.charge[youngest], p, m.point, youngest), jet, full_.coulomb()->Q());

    // the field of all others at p is minus what a charge at p would do to them
    const Points e = field_of<D>(1, p, m.point, youngest + 1);
    insert_row(m.field, youngest);
    m.field.row(youngest) = -(e.colwise() * m.point_charge).colwise().sum();
    insert_row(m.slope, youngest);
    m.slope.row(youngest).setZero();  // a fast bead: not looked at before it has a past of its own
    insert_row(m.point, youngest);
    m.point.row(youngest) = p.transpose().array();
    insert_row(m.point_charge, youngest);
    m.point_charge[youngest] = jet.charge[youngest];
    if (continues(jet.size())) set_far(m);
  }
}

template class TwoRateMotion<1>;
template class TwoRateMotion<3>;

}  // namespace treejet
