#include "core/jet/refinement.hpp"

#include <algorithm>
#include <cmath>

namespace treejet {

namespace {

using Index = Eigen::Index;

/// Rows of a table in another order, or fewer, or some twice.
template <class Array>
void take_rows(Array& a, const std::vector<Index>& rows) {
  if (a.rows() > 0) a = a(rows, Eigen::all).eval();
}

template <int D>
void take_rows(Jet<D>& jet, const std::vector<Index>& rows) {
  take_rows(jet.y, rows);
  for (auto* constants : {&jet.mass, &jet.charge, &jet.volume}) take_rows(*constants, rows);
  take_rows(jet.id, rows);
}

/// Lagrange's weights at x of the nodes s.
std::array<double, 4> lagrange(const std::array<double, 4>& s, double x) {
  std::array<double, 4> w;
  for (std::size_t a = 0; a < 4; ++a) {
    w[a] = 1;
    for (std::size_t b = 0; b < 4; ++b)
      if (b != a) w[a] *= (x - s[b]) / (s[a] - s[b]);
  }
  return w;
}

/// How far a quantity of the half below may differ from the whole, that of the half above by the opposite,
/// so that both stay between the whole and its neighbours.
double bounded(double change, double below, double here, double above) {
  const double down = below - here, up = here - above;
  if (down * up <= 0) return 0;
  const double most = std::min(std::abs(down), std::abs(up));
  return std::copysign(std::min(std::abs(change), most), down);
}

/// What a split asks of the rows before any is changed: element e of a jet, its neighbours, its middle.
template <int D>
class Middle {
 public:
  Middle(const Jet<D>& jet, Index e) : jet_(jet), e_(e) {
    const bool between = e > 0 && e + 2 < jet.size();
    smooth_ = between && turns_little(e - 1) && turns_little(e);
    state_ = (jet.y.row(e) + jet.y.row(e + 1)) / 2;
    if (smooth_) interpolate();
  }

  /// Position, velocity; stress and added columns of the half above.
  const State<D>& state() const { return state_; }
  /// By how much the half below has more of a column than the whole.
  double change(Index column) const {
    if (!smooth_) return 0;
    const double below = jet_.y(e_ - 1, column), here = jet_.y(e_, column), above = jet_.y(e_ + 1, column);
    const double V = jet_.volume[e_], way = (jet_.volume[e_ - 1] + 2 * V + jet_.volume[e_ + 1]) / 2;
    return bounded((below - above) / way * V / 4, below, here, above);
  }

 private:
  Vec<D> element(Index i) const { return position<D>(jet_.y, i) - position<D>(jet_.y, i + 1); }
  double stretch(Index i) const { return element(i).norm() / jet_.volume[i]; }
  bool turns_little(Index i) const {
    const Vec<D> a = element(i), b = element(i + 1);
    return a.dot(b) > 0.5 * a.norm() * b.norm();
  }

  void interpolate() {
    const double V = jet_.volume[e_];
    const std::array<double, 4> w = lagrange({-jet_.volume[e_ - 1], 0, V, V + jet_.volume[e_ + 1]}, V / 2);
    state_.setZero();
    for (Index k = 0; k < 4; ++k) state_ += w[static_cast<std::size_t>(k)] * jet_.y.row(e_ - 1 + k);
    const Vec<D> chord = element(e_), middle = (position<D>(jet_.y, e_) + position<D>(jet_.y, e_ + 1)) / 2;
    // the half below is (1/2 - off) chords long
    const double l = chord.norm(), here = l / V;
    const double off = (position<D>(state_, 0) - middle).dot(chord) / (l * l);
    const double wanted = -2 * off * here, change = bounded(wanted, stretch(e_ - 1), here, stretch(e_ + 1));
    for (int k = 0; k < D; ++k) state_(0, k) -= (change / (2 * here) + off) * chord[k];
  }

  const Jet<D>& jet_;
  Index e_;
  bool smooth_;
  State<D> state_;
};

/// Columns of elements: the stress, and all that are added but for those of beads.
template <int D>
std::vector<Index> columns_of_elements(const Jet<D>& jet, const std::vector<Index>& of_beads) {
  std::vector<Index> columns;
  for (Index column = stress_column<D>; column < jet.y.cols(); ++column)
    if (std::find(of_beads.begin(), of_beads.end(), column) == of_beads.end()) columns.push_back(column);
  return columns;
}

/// The part of a bead's mass and charge that belongs to the element above it. What the oldest bead stands for
/// beyond its element, half a cell or nothing, its mass tells.
template <int D>
double part_above(const Jet<D>& jet, Index i) {
  const double V = jet.volume[i];
  return i > 0 ? V / (jet.volume[i - 1] + V) : std::min(V / (2 * jet.mass[0]), 1.0);
}

/// Momentum that has been lost or gained at some beads, until all masses are the new ones.
template <int D>
struct Kick {
  std::array<Index, 3> rows;
  int count;
  Vec<D> momentum;

  void give(Jet<D>& jet) const {
    double mass = 0;
    for (int k = 0; k < count; ++k) mass += jet.mass[rows[static_cast<std::size_t>(k)]];
    for (int k = 0; k < count; ++k)
      jet.y.row(rows[static_cast<std::size_t>(k)]).template segment<D>(velocity_column<D>) +=
          (momentum / mass).transpose().array();
  }
};

}  // namespace

template <int D>
void split(Jet<D>& jet, const std::vector<Index>& elements, const std::vector<Index>& of_beads) {
  const Jet<D> whole = jet;
  const std::vector<Index> of_elements = columns_of_elements(jet, of_beads);
  std::vector<Index> rows;
  for (Index i = 0, k = 0; i < whole.size(); ++i) {
    rows.push_back(i);
    const bool is_split = k < std::ssize(elements) && elements[static_cast<std::size_t>(k)] == i;
    if (is_split) rows.push_back(i), ++k;
  }
  take_rows(jet, rows);

  std::vector<Kick<D>> kicks;
  for (std::size_t n = 0; n < elements.size(); ++n) {
    const Index e = elements[n], i = e + static_cast<Index>(n), k = i + 1;
    const Middle<D> middle(whole, e);
    const double below = part_above(whole, e) / 2, above = (1 - part_above(whole, e + 1)) / 2;
    jet.y.row(k) = middle.state();
    for (const Index column : of_elements) {
      const double change = middle.change(column);
      jet.y(i, column) = whole.y(e, column) + change;
      jet.y(k, column) = whole.y(e, column) - change;
    }
    jet.volume[i] = jet.volume[k] = whole.volume[e] / 2;
    const double from_below = whole.mass[e] * below, from_above = whole.mass[e + 1] * above;
    for (auto* constant : {&jet.mass, &jet.charge}) {
      const Eigen::ArrayXd& of_whole = constant == &jet.mass ? whole.mass : whole.charge;
      const double a = of_whole[e] * below, b = of_whole[e + 1] * above;
      (*constant)[k] = a + b;
      (*constant)[i] -= a;
      (*constant)[k + 1] -= b;
    }
    if (jet.id.size() > 0) jet.id[k] = ++jet.born;
    kicks.push_back({{i, k, k + 1},
                     3,
                     from_below * velocity<D>(whole.y, e) + from_above * velocity<D>(whole.y, e + 1) -
                         jet.mass[k] * velocity<D>(jet.y, k)});
  }
  for (const Kick<D>& kick : kicks) kick.give(jet);
}

template <int D>
void merge(Jet<D>& jet, const std::vector<Index>& beads, const std::vector<Index>& of_beads) {
  const std::vector<Index> of_elements = columns_of_elements(jet, of_beads);
  std::vector<Index> rows;
  std::vector<Kick<D>> kicks;
  Index next = 0;
  for (const Index k : beads) {
    const Index i = k - 1, j = k + 1;
    for (; next < k; ++next) rows.push_back(next);
    ++next;
    const double V = jet.volume[i] + jet.volume[k], below = jet.volume[k] / V;
    for (const Index column : of_elements)
      jet.y(i, column) = (jet.volume[i] * jet.y(i, column) + jet.volume[k] * jet.y(k, column)) / V;
    Vec<D> momentum = Vec<D>::Zero();
    for (auto* constant : {&jet.mass, &jet.charge}) {
      const double a = (*constant)[k] * below, b = (*constant)[k] - a;
      (*constant)[i] += a;
      (*constant)[j] += b;
      if (constant != &jet.mass) continue;
      const Vec<D> v = velocity<D>(jet.y, k);
      momentum = a * (v - velocity<D>(jet.y, i)) + b * (v - velocity<D>(jet.y, j));
    }
    jet.volume[i] = V;
    const Index row = static_cast<Index>(rows.size()) - 1;  // of i, in the end
    kicks.push_back({{row, row + 1, 0}, 2, momentum});
  }
  for (; next < jet.size(); ++next) rows.push_back(next);
  take_rows(jet, rows);
  for (const Kick<D>& kick : kicks) kick.give(jet);
}

template void split<1>(Jet<1>&, const std::vector<Index>&, const std::vector<Index>&);
template void split<3>(Jet<3>&, const std::vector<Index>&, const std::vector<Index>&);
template void merge<1>(Jet<1>&, const std::vector<Index>&, const std::vector<Index>&);
template void merge<3>(Jet<3>&, const std::vector<Index>&, const std::vector<Index>&);

}  // namespace treejet
