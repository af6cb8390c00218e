#include "forces/terms/slender_self_field.hpp"

#include <array>
#include <cmath>
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
    const double inverse = c.inverse_length[e], V = c.volume[e];
    const double g = plain_g(inverse, c.section.squared_radius(V * inverse));
    const Logarithm logarithm = close ? limited(g) : Logarithm{g, 1};
    const double charges = c.Q * c.charge[e] * c.inverse_mass[e] * (c.charge[e + 1] * c.inverse_mass[e + 1]);
    tension[e] = V * V * charges * inverse * inverse * tension_factor(logarithm);
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

double length_where_limiter_is_gone(Section section) {
  // g = 3/2 ln l - ln(a_0^2 l_step V) / 2 + ln 2 - gamma, here of V = 1
  const double constant = section.squared_radius(1);
  return std::cbrt(constant * std::exp(2 * (limiter_is_gone + std::numbers::egamma)) / 4);
}

}  // namespace

/// Q Q_e^2; the nozzle continues the jet with its charge over mass, 1.
template <int D>
double SlenderSelfField<D>::charges(const Chain<D>& c, int i) const {
  const double up = i + 1 < c.beads ? c.point_charge[i + 1] * c.inverse_mass[i + 1] : 1;
  return Q_ * c.volume[i] * c.volume[i] * c.point_charge[i] * c.inverse_mass[i] * up;
}

template <int D>
void SlenderSelfField<D>::prepare(const Chain<D>& c, Rows, Threads) {
  const int settled = c.beads - 1;  // elements whose volume has stopped to grow
  if (!uneven_ || (joints_.size() == c.beads && (volume_ == c.volume.head(settled)).all())) return;
  volume_ = c.volume.head(settled);
  joints_ = joints_between(c.volume);
}

template <int D>
void SlenderSelfField<D>::add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const {
  constexpr int at_once = 32;  // the limiter is at work near the nozzle only
  const double far = length_where_limiter_is_gone(section_);
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
    const double largest = c.volume.segment(element, count).maxCoeff();
    const bool close = c.inverse_length.segment(element, count).maxCoeff() * far * std::cbrt(largest) > 1;
    double* const to = tension.data() + (first == 0);
    tension[0] = 0;
    const bool youngest = last == c.beads;
    if (close) set_tensions<true>(elements, count - youngest, to);
    if (!close) set_tensions<false>(elements, count - youngest, to);
    if (uneven_)
      for (int k = 0; k < count - youngest; ++k) {
        const double inverse = c.inverse_length[element + k];
        to[k] += charges(c, element + k) * inverse * inverse * joints_[element + k];
      }
    if (youngest) to[count - 1] = tension_of_youngest(c);
    const auto t = columns<D>(c.tangent);
    const int between = std::max(first, 1);
    if (first == 0)
      for (int k = 0; k < D; ++k) a(0, k) -= to[0] * t[k][0] * c.inverse_mass[0];
    pull<D>(t, c.inverse_mass.data(), tension.data() + (between - first), between, last, columns<D>(a));
  }
}

template <int D>
double SlenderSelfField<D>::tension_of_youngest(const Chain<D>& c) const {
  const int i = c.beads - 1;
  const double joint = uneven_ ? joints_[i] : 0;
  const auto tension = [&](double inverse) {
    const double squared_radius = section_.squared_radius(c.volume[i] * inverse);
    return inverse * inverse * (tension_factor(limited(plain_g(inverse, squared_radius))) + joint);
  };
  const double d = 1 / c.inverse_length[i], whole = tension(c.inverse_length[i]);
  if (c.points() == c.beads + 1) return charges(c, i) * whole;
  const double s = c.point_charge[c.beads];
  return charges(c, i) * ((1 - s) * whole + s * tension(1 / (d - section_.l_step)));
}

/// T t has the derivative  T' t t' + T / l (1 - t t')  by d; and ds/dd = pi / l_step sin(2 pi (d / l_step -
/// 3/2)).
template <int D>
void SlenderSelfField<D>::differentiate(const Chain<D>& c, LocalJacobian<D>& J) const {
  struct Answer {
    double tension, stiffness;
  };
  const auto answer = [&](int i, double inverse) {
    const Logarithm g = limited(plain_g(inverse, section_.squared_radius(c.volume[i] * inverse)));
    const double joint = uneven_ ? joints_[i] : 0, square = inverse * inverse;
    return Answer{square * (tension_factor(g) + joint), square * inverse * (stiffness_factor(g) - 2 * joint)};
  };
  for (int i = 0; i < c.beads; ++i) {
    const double inverse = c.inverse_length[i], d = 1 / inverse;
    Answer T = answer(i, inverse);
    if (i + 1 == c.beads && c.points() == c.beads + 2) {
      using std::numbers::pi;
      const double l_step = section_.l_step, s = c.point_charge[c.beads];
      const double fading = s > 0 && s < 1 ? pi / l_step * std::sin(2 * pi * (d / l_step - 1.5)) : 0;
      const Answer below = answer(i, 1 / (d - l_step));
      T = {(1 - s) * T.tension + s * below.tension,
           (1 - s) * T.stiffness + s * below.stiffness + fading * (below.tension - T.tension)};
    }
    using Block = Eigen::Matrix<double, D, D>;
    const Vec<D> t = c.tangent.row(i).matrix().transpose();
    const Block along = t * t.transpose();
    J.element[index(i)].tension_by_d +=
        charges(c, i) * (T.stiffness * along + T.tension * inverse * (Block::Identity() - along));
  }
}

template <int D>
double SlenderSelfField<D>::energy(const Chain<D>& c) const {
  double sum = 0;
  const Eigen::ArrayXd joints =
      uneven_ ? joints_between(c.volume) : Eigen::ArrayXd(Eigen::ArrayXd::Zero(c.beads));
  for (int i = 0; i < c.beads; ++i) {
    const double inverse = c.inverse_length[i];
    const double squared_radius = section_.squared_radius(c.volume[i] * inverse);
    sum += charges(c, i) * inverse * (limited(plain_g(inverse, squared_radius)).value - joints[i]);
  }
  return sum;
}

template class SlenderSelfField<1>;
template class SlenderSelfField<3>;

}  // namespace treejet
