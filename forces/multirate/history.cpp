#include "forces/multirate/history.hpp"

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/multirate/field_of_charge.hpp"

namespace treejet {

std::array<FastEnd, 2> fast_ends(int beads, int points) {
  return {FastEnd{{0, fast_old}, {0, fast_old + near_points}},
          FastEnd{{beads - fast_young, beads}, {beads - fast_young - near_points, points}}};
}

template <int D>
void set_near_field(const typename Chain<D>::Points& point, const Eigen::ArrayXd& charge, const FastEnd& end,
                    typename Chain<D>::Points& field) {
  const int first = end.window.first;
  coulomb_direct<D>({columns<D>(point, 0, first), charge.data() + first, end.window.size()},
                    {end.fast.first - first, end.fast.last - first}, columns<D>(field, 0, first));
}

namespace {

/// Adds the field e of some charge at the first beads to what is remembered.
template <int D>
void add_field(PastEvaluation<D>& m, const typename Chain<D>::Points& e, const Jet<D>& jet, double Q) {
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
PastEvaluation<D>::PastEvaluation(double when, const Chain<D>& c, const Jet<D>& jet, const Points& E,
                                  const State<D>& slopes, double Q)
    : t(when),
      point(c.point.topRows(c.beads + 1)),
      point_charge(c.point_charge.head(c.beads + 1)),
      field(E.topRows(c.beads)),
      slope(slopes.rightCols(slopes.cols() - D)) {
  if (!jet.held) return;
  const int n = c.beads, nozzle = c.points() - 1;
  const Vec<D> held = c.point.row(n).matrix().transpose();
  add_field<D>(*this, field_of<D>(-c.point_charge[n], held, c.point, n), jet, Q);
  point.row(n) = c.point.row(nozzle);
  point_charge[n] = c.point_charge[nozzle];
}

template <int D>
void PastEvaluation<D>::set_far() {
  const auto n = static_cast<int>(field.rows());
  far.resize(n + 1, Eigen::NoChange);
  for (const FastEnd& end : fast_ends(n, n + 1)) {
    set_near_field<D>(point, point_charge, end, far);
    const int i = end.fast.first, m = end.fast.size();
    far.middleRows(i, m) = field.middleRows(i, m) - far.middleRows(i, m);
  }
}

template <int D>
bool History<D>::continuable(Eigen::Index beads) const {
  return remembered_ == count && beads >= fast_region_beads;
}

template <int D>
double History<D>::since(double t) const {
  return remembered_ > 0 ? t - past_[0].t : std::numeric_limits<double>::infinity();
}

template <int D>
typename History<D>::Weights History<D>::weights(double t) const {
  const double t0 = past_[0].t, t1 = past_[1].t, t2 = past_[2].t;
  return {(t - t1) * (t - t2) / ((t0 - t1) * (t0 - t2)), (t - t0) * (t - t2) / ((t1 - t0) * (t1 - t2)),
          (t - t0) * (t - t1) / ((t2 - t0) * (t2 - t1))};
}

template <int D>
std::array<const double*, History<D>::count> History<D>::slopes(int column, int first) const {
  std::array<const double*, count> from;
  for (int k = 0; k < count; ++k) from[k] = past_[k].slope.col(column).data() + first;
  return from;
}

template <int D>
void History<D>::visit(Archive& state) {
  state(past_, remembered_);
  if (!state.reading()) return;
  const Eigen::Index n = beads(), far = continuable(n) ? n + 1 : 0;
  const auto alike = [&](const PastEvaluation<D>& m) {
    return m.slope.rows() == n && m.slope.cols() == columns() && m.field.rows() == n &&
           m.point.rows() == n + 1 && m.point_charge.size() == n + 1 && m.far.rows() >= far;
  };
  if (remembered_ < 0 || remembered_ > count ||
      !std::all_of(past_.begin(), past_.begin() + remembered_, alike))
    throw FileError("the checkpoint remembers evaluations that are not of one jet");
}

template <int D>
bool History<D>::remember(PastEvaluation<D>&& now) {
  const bool continued = continuable(now.field.rows());  // then all have their far field, `now` as well
  // values too close in time would make the parabola amplify their own errors
  const double usual = remembered_ >= 2 ? past_[0].t - past_[1].t : 0;
  const bool replaces = remembered_ > 0 && now.t - past_[0].t <= 0.2 * usual;
  if (!replaces) {
    std::rotate(past_.begin(), past_.end() - 1, past_.end());
    remembered_ = std::min(remembered_ + 1, count);
  }
  with_states_ = now.state.rows() > 0;
  past_[0] = std::move(now);
  if (!continued && continuable(beads())) {
    for (auto& m : past_) m.set_far();
  }
  return !replaces;
}

template <int D>
void History<D>::before_removal(const Jet<D>& jet, double Q) {
  for (int k = 0; k < remembered_; ++k) {
    PastEvaluation<D>& m = past_[k];
    const Vec<D> oldest = m.point.row(0).matrix().transpose();
    drop_first_row(m.point);
    drop_first_row(m.point_charge);
    drop_first_row(m.field);
    drop_first_row(m.slope);
    if (m.state.rows() > 0) drop_first_row(m.state);
    Jet<D> left;
    left.mass = jet.mass.tail(jet.size() - 1);
    left.charge = jet.charge.tail(jet.size() - 1);
    add_field<D>(m, field_of<D>(-jet.charge[0], oldest, m.point, m.field.rows()), left, Q);
    if (continuable(jet.size() - 1)) m.set_far();
  }
}

template <int D>
void History<D>::after_release(const Jet<D>& jet, double Q, const Decomposition<D>& all) {
  const Eigen::Index youngest = jet.size() - 1;
  const auto [first_own, last_own] = all.own_rows(youngest);
  for (int k = 0; k < remembered_; ++k) {
    PastEvaluation<D>& m = past_[k];
    const Vec<D> p = position<D>(jet.y, youngest) + (m.t - jet.t) * velocity<D>(jet.y, youngest);
    add_field<D>(m, field_of<D>(jet.charge[youngest], p, m.point, youngest), jet, Q);

    // the field of all others at p is minus what a charge at p would do to them
    const typename Chain<D>::Points e = field_of<D>(1, p, m.point, youngest + 1);
    Eigen::ArrayXd charge = m.point_charge;  // counted here: the nozzle's by who holds the youngest bead
    charge.head(first_own).setZero();
    if (last_own < youngest) charge.tail(youngest + 1 - last_own).setZero();
    Eigen::ArrayXd sum = -(e.colwise() * charge).colwise().sum().transpose();
    all.add_up(sum);
    insert_row(m.field, youngest);
    m.field.row(youngest) = sum.transpose();
    insert_row(m.slope, youngest);
    m.slope.row(youngest).setZero();  // a fast bead: not looked at before it has a past of its own
    insert_row(m.point, youngest);
    m.point.row(youngest) = p.transpose().array();
    insert_row(m.point_charge, youngest);
    m.point_charge[youngest] = jet.charge[youngest];
    if (m.state.rows() > 0) {
      insert_row(m.state, youngest);
      m.state.row(youngest) = jet.y.row(youngest);
      m.state.row(youngest).template head<D>() = p.transpose().array();
    }
    if (continuable(jet.size())) m.set_far();
  }
}

template <int D>
std::vector<Jet<D>> History<D>::past(const Jet<D>& jet) {
  std::vector<Jet<D>> all;
  if (remembered_ < count) forget();
  for (int k = 0; k < remembered_; ++k) {
    all.push_back(at(jet, past_[k].t, past_[k].state));
    all.back().held = false;
  }
  return all;
}

template <int D>
int History<D>::after_refinement(const Jet<D>& jet, std::vector<Jet<D>> past, FullMotion<D>& full) {
  if (past.empty()) return 0;
  State<D> slope;
  full(jet, jet.t, jet.y, slope);
  lead_to(jet.t, slope, past);
  for (std::size_t k = 0; k < past.size(); ++k) {
    const Jet<D>& then = past[k];
    full(then, then.t, then.y, slope);
    past_[k] = {then.t, full.chain(), then, full.field(), slope, full.Q()};
    past_[k].state = then.y;
  }
  if (continuable(beads()))
    for (auto& m : past_) m.set_far();
  return count + 1;
}

/// Jets of the past that are refined as the jet of now do not move as the refined jet does: what was
/// interpolated does not follow its forces to the last bit. Gives them the past of the latter,
///
///     v(t_k) += tau a ,    r(t_k) += tau u + tau^2 / 2 a ,    tau = t_k - t ,
///
/// columns as v; u and a, of second order in the elements, are what its slope differs in from the derivative
/// of the parabola through them.
template <int D>
void History<D>::lead_to(double t, State<D> slope, std::vector<Jet<D>>& past) {
  for (std::size_t k = 0; k < count; ++k) {
    const double a = past[(k + 1) % count].t, b = past[(k + 2) % count].t, c = past[k].t;
    slope -= (2 * t - a - b) / ((c - a) * (c - b)) * past[k].y;
  }
  for (Jet<D>& jet : past) {
    const double tau = jet.t - t;
    jet.y += tau * slope;
    jet.y.template leftCols<D>() += tau * tau / 2 * slope.template middleCols<D>(velocity_column<D>);
  }
}

/// Of each moment: position, charge, field, slopes, and the state, of which a slope has all but the
/// positions.
template <int D>
Eigen::Index History<D>::words_of_bead() const {
  return 2 * D + 1 + columns() + (with_states_ ? D + columns() : 0);
}

template <int D>
Eigen::ArrayXXd History<D>::of_beads(Eigen::Index first, Eigen::Index rows) const {
  const Eigen::Index words = words_of_bead();
  Eigen::ArrayXXd table(rows, remembered_ * words);
  for (int k = 0; k < remembered_; ++k) {
    const PastEvaluation<D>& m = past_[k];
    auto words_of = table.middleCols(k * words, words);
    words_of.template leftCols<D>() = m.point.middleRows(first, rows);
    words_of.col(D) = m.point_charge.segment(first, rows);
    words_of.template middleCols<D>(D + 1) = m.field.middleRows(first, rows);
    words_of.middleCols(2 * D + 1, columns()) = m.slope.middleRows(first, rows);
    if (with_states_) words_of.rightCols(D + columns()) = m.state.middleRows(first, rows);
  }
  return table;
}

template <int D>
void History<D>::set_beads(const Eigen::ArrayXXd& table) {
  const Eigen::Index n = table.rows(), words = words_of_bead(), columns = this->columns();
  for (int k = 0; k < remembered_; ++k) {
    PastEvaluation<D>& m = past_[k];
    const auto words_of = table.middleCols(k * words, words);
    const Vec<D> nozzle = m.point.row(m.point.rows() - 1).matrix().transpose();
    const double charge = m.point_charge[m.point_charge.size() - 1];
    m.point.resize(n + 1, D);
    m.point_charge.resize(n + 1);
    m.point.topRows(n) = words_of.template leftCols<D>();
    m.point.row(n) = nozzle.transpose().array();
    m.point_charge.head(n) = words_of.col(D);
    m.point_charge[n] = charge;
    m.field = words_of.template middleCols<D>(D + 1);
    m.slope = words_of.middleCols(2 * D + 1, columns);
    if (with_states_) m.state = words_of.rightCols(D + columns);
    if (continuable(n)) m.set_far();
  }
}

template <int D>
void History<D>::visit_all_but_beads(Archive& state) {
  Eigen::Index columns = this->columns();
  state(remembered_, columns, with_states_);
  if (state.reading() && (remembered_ < 0 || remembered_ > count || columns < 0))
    throw FileError("the checkpoint remembers what cannot be");
  for (int k = 0; k < remembered_; ++k) {
    PastEvaluation<D>& m = past_[k];
    Points nozzle = m.point.bottomRows(std::min<Eigen::Index>(m.point.rows(), 1));
    Eigen::ArrayXd charge = m.point_charge.tail(nozzle.rows());
    state(m.t, nozzle, charge);
    if (!state.reading()) continue;
    if (nozzle.rows() != 1 || charge.size() != 1) throw FileError("the checkpoint remembers what cannot be");
    m.point = nozzle;
    m.point_charge = charge;
    m.field.resize(0, D);
    m.slope.resize(0, columns);
    m.state.resize(0, with_states_ ? D + columns : m.state.cols());
  }
}

template struct PastEvaluation<1>;
template struct PastEvaluation<3>;
template class History<1>;
template class History<3>;
template void set_near_field<1>(const Chain<1>::Points&, const Eigen::ArrayXd&, const FastEnd&,
                                Chain<1>::Points&);
template void set_near_field<3>(const Chain<3>::Points&, const Eigen::ArrayXd&, const FastEnd&,
                                Chain<3>::Points&);

}  // namespace treejet
