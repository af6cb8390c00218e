#include "forces/terms/slender_self_field.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/simd_clones.hpp"
#include "forces/terms/joints.hpp"
#include "forces/terms/wide_logarithm.hpp"

namespace treejet {

namespace {

constexpr double sharpness = 8;          ///< of the limiter
constexpr double limiter_is_gone = 4.7;  ///< from this g on it does not change a bit: e^(-8 g) < 2^-53

/// g as limited, and its slope in the plain one.
struct Logarithm {
  double value, slope;
};

[[gnu::always_inline]] inline Logarithm limited(double g) {
  const double tail = wide_exp(-sharpness * std::abs(g)), over = 1 / (1 + tail);
  return {(g + std::abs(g)) / 2 + wide_log(1 + tail) / sharpness, g > 0 ? over : tail * over};
}

[[gnu::always_inline]] inline double plain_g(double inverse_length, double squared_radius) {
  return wide_log(4 / (inverse_length * inverse_length * squared_radius)) / 2 - std::numbers::egamma;
}

/// T l^2 / Q_e^2 and, for the derivative, T' l^3 / Q_e^2.
double tension_factor(const Logarithm& g) {
  return 1.5 * g.slope - g.value;
}
double stiffness_factor(const Logarithm& g) {
  return 2 * g.value - 4.5 * g.slope + 2.25 * sharpness * g.slope * (1 - g.slope);
}

/// That of the joints; the youngest element, which grows, counts like the one below it.
Eigen::ArrayXd joints_between(Eigen::ArrayXd volume) {
  const Eigen::Index n = volume.size();
  if (n > 1) volume[n - 1] = volume[n - 2];
  return tension_of_joints(volume);
}

/// The arrays of a chain that the tension of an element is made of, from one element on.
struct Elements {
  const double *charge, *inverse_mass, *inverse_length, *volume;
  double Q;
  Section section;
};

/// Elements whose upper neighbour is a row. `close`: the limiter may be at work.
template <bool close>
TREEJET_SIMD_CLONES void set_tensions(Elements c, int count, double* tension) {
#pragma GCC ivdep
  for (int e = 0; e < count; ++e) {
    const double inverse = c.inverse_length[e], line = c.volume[e] * inverse;
    const double g = plain_g(inverse, c.section.squared_radius(line));
    const Logarithm logarithm = close ? limited(g) : Logarithm{g, 1};
    const double charges = c.Q * c.charge[e] * c.inverse_mass[e] * (c.charge[e + 1] * c.inverse_mass[e + 1]);
    tension[e] = charges * line * line * tension_factor(logarithm);
  }
}

/// Beads between two elements; `tension` is that of bead i at i + 1 - first.
template <int D>
TREEJET_SIMD_CLONES void pull(std::array<const double*, D> t, const double* inverse_mass,
                              const double* tension, int first, int last, std::array<double*, D> a) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const double above = tension[i + 1 - first], below = tension[i - first];
    for (int k = 0; k < D; ++k) a[k][i] += (below * t[k][i - 1] - above * t[k][i]) * inverse_mass[i];
  }
}

/// l^3 / V from which on the limiter does not change a bit.
double where_limiter_is_gone(Section section) {
  // g = 3/2 ln l - ln(a_0^2 l_step V) / 2 + ln 2 - gamma
  return section.squared_radius(1) * std::exp(2 * (limiter_is_gone + std::numbers::egamma)) / 4;
}

/// What the middle of an element that grows from a volume of 1 to 2, with the charge V - 1 there and 1/2 at
/// either end, lacks of the tension of whole elements, over Q_e^2 / d^2: between equal elements on a straight
/// line  psi(1) - psi(V) + (V - 1) (psi'(V / 2) - psi'(V)) , here to 0.5 % of its largest value, 0.20.
double lack_of_growing(double V) {
  constexpr double slope = std::numbers::pi * std::numbers::pi / 6;  // at V = 1, exact
  return slope * (V - 1) * (2 - V) * std::pow(V, -1.9);
}

}  // namespace

/// Of the volume that element i had as it left the nozzle; the nozzle itself is fresh.
template <int D>
double SlenderSelfField<D>::left(const Chain<D>& c, int i) const {
  return drying_ && i < c.beads ? drying_->remaining(c.column(0)[i]) : 1;
}

/// Q_e^2 / V_e^2 = Q c_i c_up nu_up / nu_e; the nozzle continues the jet with its charge over mass, 1.
template <int D>
double SlenderSelfField<D>::charges(const Chain<D>& c, int i) const {
  const double up = i + 1 < c.beads ? c.point_charge[i + 1] * c.inverse_mass[i + 1] : 1;
  return Q_ * c.point_charge[i] * c.inverse_mass[i] * up * left(c, i + 1) / left(c, i);
}

/// Anew only where beads have come, gone or been refined: two rates evaluate 44 beads of a jet of any length.
template <int D>
void SlenderSelfField<D>::prepare(const Chain<D>& c, Rows, Threads) {
  if (!uneven_) return;
  const Eigen::ArrayXd& volume = *c.volume_at_nozzle;
  const bool same =
      c.census.born > 0 ? c.census == census_ : volume_.size() == volume.size() && (volume_ == volume).all();
  if (same) return;
  census_ = c.census;
  volume_ = volume;
  joints_ = joints_between(volume);
}

/// What unequal neighbours add to the tension of an element.
template <int D>
double SlenderSelfField<D>::joint(const Chain<D>& c, int i) const {
  return uneven_ ? joints_[c.row_of_jet(i)] : 0;
}

template <int D>
void SlenderSelfField<D>::add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const {
  constexpr int at_once = 32;  // the limiter is at work near the nozzle only
  const double far = where_limiter_is_gone(section_);
  std::array<double, at_once + 1> tension;
  for (int first = rows.first; first < rows.last; first += at_once) {
    const int last = std::min(first + at_once, rows.last), element = std::max(first - 1, 0);
    const int count = last - element;
    const Elements elements{c.point_charge.data() + element,
                            c.inverse_mass.data() + element,
                            c.inverse_length.data() + element,
                            c.volume.data() + element,
                            Q_,
                            section_};
    const bool close =
        (c.inverse_length.segment(element, count).cube() * c.volume.segment(element, count)).maxCoeff() *
            far >
        1;
    double* const to = tension.data() + (first == 0);
    tension[0] = 0;
    const bool youngest = last == c.beads;
    if (close) set_tensions<true>(elements, count - youngest, to);
    if (!close) set_tensions<false>(elements, count - youngest, to);
    if (drying_)
      for (int k = 0; k < count - youngest; ++k) to[k] *= left(c, element + k + 1) / left(c, element + k);
    if (uneven_)
      for (int k = 0; k < count - youngest; ++k) {
        const double line = c.volume[element + k] * c.inverse_length[element + k];
        to[k] += charges(c, element + k) * line * line * joint(c, element + k);
      }
    if (youngest) to[count - 1] = tension_of_youngest(c);
    const auto t = columns<D>(c.tangent);
    const int between = std::max(first, 1);
    if (first == 0)
      for (int k = 0; k < D; ++k) a(0, k) -= to[0] * t[k][0] * c.inverse_mass[0];
    pull<D>(t, c.inverse_mass.data(), tension.data() + (between - first), between, last, columns<D>(a));
  }
}

namespace {

/// Of an element of volume V with Q_e = V: U_e, T_e and dT_e/dl at length l.
struct Answer {
  double energy, tension, stiffness;
};

/// `joint`: what unequal neighbours add to T.
Answer answer(Section section, double V, double l, double joint) {
  const double line = V / l;
  const Logarithm g = limited(plain_g(1 / l, section.squared_radius(line)));
  return {V * line * (g.value - joint), line * line * (tension_factor(g) + joint),
          line * line / l * (stiffness_factor(g) - 2 * joint)};
}

/// Of the youngest element, of length d, by d. `left`: of the volume that has been fed.
template <int D>
Answer of_youngest(const Chain<D>& c, Section section, double joint, double left) {
  const int i = c.beads - 1;
  const double V = c.volume[i], d = 1 / c.inverse_length[i];
  if (c.held_mass > 0) {
    // dU/dd of as many elements in a row is that of one of them
    const double elements = V / left;
    const Answer one = answer(section, left, d / elements, joint);
    const double lack = lack_of_growing(elements) * V * V / d;
    return {elements * one.energy - lack, one.tension + lack / d,
            one.stiffness / elements - 2 * lack / (d * d)};
  }
  const Answer whole = answer(section, V, d, joint);
  const double s = c.holds_bead() ? c.point_charge[c.beads] : 0;
  if (s == 0) return whole;
  using std::numbers::pi;
  const double l_step = section.l_step,
               fading = s < 1 ? pi / l_step * std::sin(2 * pi * (d / l_step - 1.5)) : 0;
  const Answer below = answer(section, V, d - l_step, joint);
  return {std::numeric_limits<double>::quiet_NaN(), (1 - s) * whole.tension + s * below.tension,
          (1 - s) * whole.stiffness + s * below.stiffness + fading * (below.tension - whole.tension)};
}

template <int D>
Answer of_element(const Chain<D>& c, int i, Section section, double joint, double left) {
  return i + 1 == c.beads ? of_youngest(c, section, joint, left)
                          : answer(section, c.volume[i], 1 / c.inverse_length[i], joint);
}

}  // namespace

template <int D>
double SlenderSelfField<D>::tension_of_youngest(const Chain<D>& c) const {
  return charges(c, c.beads - 1) *
         of_youngest(c, section_, joint(c, c.beads - 1), left(c, c.beads - 1)).tension;
}

/// T t has the derivative  T' t t' + T / l (1 - t t')  by d.
template <int D>
void SlenderSelfField<D>::differentiate(const Chain<D>& c, LocalJacobian<D>& J) const {
  for (int i = 0; i < c.beads; ++i) {
    const Answer T = of_element(c, i, section_, joint(c, i), left(c, i));
    using Block = Eigen::Matrix<double, D, D>;
    const Vec<D> t = c.tangent.row(i).matrix().transpose();
    const Block along = t * t.transpose();
    J.element[index(i)].tension_by_d +=
        charges(c, i) * (T.stiffness * along + T.tension * c.inverse_length[i] * (Block::Identity() - along));
  }
}

template <int D>
double SlenderSelfField<D>::energy(const Chain<D>& c) const {
  double sum = 0;
  const Eigen::ArrayXd joints =
      uneven_ ? joints_between(*c.volume_at_nozzle) : Eigen::ArrayXd(Eigen::ArrayXd::Zero(c.beads));
  for (int i = 0; i < c.beads; ++i)
    sum += charges(c, i) * of_element(c, i, section_, joints[i], left(c, i)).energy;
  return sum;
}

template class SlenderSelfField<1>;
template class SlenderSelfField<3>;

}  // namespace treejet
