#include "forces/terms/air_drag.hpp"

#include <cmath>
#include <numbers>

#include "forces/terms/surface_tension.hpp"

namespace treejet {

namespace {

template <int D>
Vec<D> tangent(const Chain<D>& c, int element) {
  return c.tangent.row(element).matrix().transpose();
}

/// Curvature times the unit vector to its centre, of a bead that has an element on either side. A held bead
/// is the upper neighbour of the youngest one.
Vec<3> curvature_at(const Chain<3>& c, int i) {
  const Vec<3> down = c.inverse_length[i - 1] * tangent<3>(c, i - 1);
  const Vec<3> to_above = (c.point.row(i + 1) - c.point.row(i)).matrix().transpose();
  const Vec<3> up = to_above / to_above.squaredNorm();
  const Triple k = curvature({down[0], down[1], down[2]}, {up[0], up[1], up[2]});
  return {k[0], k[1], k[2]};
}

}  // namespace

/// Velocity of a bead through the gas.
template <int D>
Vec<D> AirDrag<D>::wind(const Chain<D>& c, int i) const {
  Vec<D> w = c.velocity(i);
  w[0] -= gas_.velocity;
  return w;
}

template <int D>
double AirDrag<D>::radius(const Chain<D>& c, int element) const {
  return std::sqrt(c.volume[element] * section_.squared_radius(c.inverse_length[element]));
}

/// On a whole element that moves at w through the gas.
template <int D>
Vec<D> AirDrag<D>::force(const Chain<D>& c, int element, const Vec<D>& w) const {
  const Vec<D> t = tangent<D>(c, element);
  const double w_t = w.dot(t), a = radius(c, element), l = 1 / c.inverse_length[element];
  Vec<D> f = -l * along(gas_, a, std::abs(w_t)).value * (to_nozzle_ ? std::abs(w_t) : w_t) * t;
  if (full_ && D == 3) {
    const Vec<D> w_n = w - w_t * t;
    f -= l * across(gas_, a, w_n.norm()).value * w_n;
  }
  return f;
}

/// With R = force over speed and p its exponent, R w_t t gives p R t t' , and R w_n gives
/// R (1 - t t') + (p - 1) R n n' , n the direction of w_n.
template <int D>
typename AirDrag<D>::Block AirDrag<D>::force_by_velocity(const Chain<D>& c, int element,
                                                         const Vec<D>& w) const {
  const Vec<D> t = tangent<D>(c, element);
  const double w_t = w.dot(t), a = radius(c, element), l = 1 / c.inverse_length[element];
  const double sign = to_nozzle_ && w_t < 0 ? -1 : 1;
  Block by_velocity = -sign * l * along(gas_, a, std::abs(w_t)).by_speed() * t * t.transpose();
  if (full_ && D == 3) {
    const Vec<D> w_n = w - w_t * t;
    const double speed = w_n.norm();
    const Resistance R = across(gas_, a, speed);
    const Vec<D> n = speed > 0 ? Vec<D>(w_n / speed) : Vec<D>(Vec<D>::Zero());
    by_velocity -=
        l * R.value * (Block::Identity() - t * t.transpose() + (R.exponent - 1) * n * n.transpose());
  }
  return by_velocity;
}

template <int D>
void AirDrag<D>::add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const {
  for (int i = rows.first; i < rows.last; ++i) {
    const Vec<D> w = wind(c, i);
    Vec<D> f = force(c, i, w);
    if (full_) f = f / 2 + (i > 0 ? Vec<D>(force(c, i - 1, w) / 2) : Vec<D>(Vec<D>::Zero()));
    a.row(i) += c.inverse_mass[i] * f.transpose().array();
  }
}

template <int D>
void AirDrag<D>::differentiate(const Chain<D>& c, LocalJacobian<D>& J) const {
  auto& by_velocity = J.by_velocity();
  for (int i = 0; i < c.beads; ++i) {
    const Vec<D> w = wind(c, i);
    Block f = force_by_velocity(c, i, w);
    if (full_) f = f / 2 + (i > 0 ? Block(force_by_velocity(c, i - 1, w) / 2) : Block(Block::Zero()));
    by_velocity[std::size_t(i)] += c.inverse_mass[i] * f;
  }
}

double AirLift::speed_along(const Chain<3>& c, int i) const {
  return c.velocity(i).dot(tangent<3>(c, i)) - gas_.velocity * c.tangent(i, 0);
}

/// - l_i rho pi ((a_i + a_{i-1}) / 2)^2 k c_i
Vec<3> AirLift::over_squared_speed(const Chain<3>& c, int i) const {
  const double above = c.volume[i] * section_.squared_radius(c.inverse_length[i]),
               below = c.volume[i - 1] * section_.squared_radius(c.inverse_length[i - 1]);
  const double mean_square = (above + below + 2 * std::sqrt(above * below)) / 4;
  const double length = length_ > 0 ? length_ : 1 / c.inverse_length[i];
  return -gas_.density * std::numbers::pi * mean_square * length * curvature_at(c, i);
}

void AirLift::add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const {
  for (int i = std::max(rows.first, 1); i < rows.last; ++i) {
    const double w_t = speed_along(c, i);
    a.row(i) += c.inverse_mass[i] * w_t * w_t * over_squared_speed(c, i).transpose().array();
  }
}

/// d(w_t^2)/dv = 2 w_t t
void AirLift::differentiate(const Chain<3>& c, LocalJacobian<3>& J) const {
  auto& by_velocity = J.by_velocity();
  for (int i = 1; i < c.beads; ++i)
    by_velocity[std::size_t(i)] +=
        c.inverse_mass[i] * 2 * speed_along(c, i) * over_squared_speed(c, i) * tangent<3>(c, i).transpose();
}

template class AirDrag<1>;
template class AirDrag<3>;

}  // namespace treejet
