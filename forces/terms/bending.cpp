#include "forces/terms/bending.hpp"

#include <Eigen/Geometry>

namespace treejet {

namespace {

Vec<3> tangent(const Chain<3>& c, int element) {
  return c.tangent.row(element).matrix().transpose();
}

/// A bead between two elements, and how its bend changes.
struct Bend {
  Vec<3> K, mean;       ///< mean: t_- + t_+, not a unit vector
  Vec<3> K_rate, spin;  ///< dK/dt, Omega
  double l, strain_rate, volume_by_length;

  Bend(const Chain<3>& c, int i) {
    const Vec<3> before = tangent(c, i - 1), after = tangent(c, i);
    const double below = 1 / c.inverse_length[i - 1], above = 1 / c.inverse_length[i];
    K = before - after;
    mean = before + after;
    l = (below + above) / 2;
    strain_rate = (below * c.strain_rate[i - 1] + above * c.strain_rate[i]) / (2 * l);
    volume_by_length = (c.volume[i - 1] + c.volume[i]) / (2 * l);
  }

  void set_rates(const Chain<3>& c, int i) {
    const Vec<3> before = turning(c, i - 1), after = turning(c, i);
    K_rate = before - after;
    spin = mean.cross(before + after) / mean.squaredNorm();
  }

 private:
  /// Of an element's tangent.
  static Vec<3> turning(const Chain<3>& c, int element) {
    const Vec<3> t = tangent(c, element), w = c.velocity(element) - c.velocity_above(element);
    return c.inverse_length[element] * (w - t * t.dot(w));
  }
};

double modulus(const BendingMoment::Setting& s, double volume_by_length) {
  const double squared_radius = s.section.squared_radius(volume_by_length);
  return s.F_ve * squared_radius * squared_radius / (4 * s.section.radius * s.section.radius);
}

}  // namespace

bool BendingMoment::has_moment(const Chain<3>& c, int i) const {
  const int first = c.from_oldest ? 1 : 0, last = c.beads - (c.to_youngest && set_.fresh_youngest ? 1 : 0);
  return first <= i && i < last;
}

/// Where a part of a jet begins it lacks the element below its first bead.
bool BendingMoment::bends(const Chain<3>& c, int i) const {
  return i > 0 && has_moment(c, i);
}

Vec<3> BendingMoment::at(const Chain<3>& c, int i) const {
  if (!has_moment(c, i)) return Vec<3>::Zero();
  return {c.column(set_.first)[i], c.column(set_.first + 1)[i], c.column(set_.first + 2)[i]};
}

Vec<3> BendingMoment::rate(const Chain<3>& c, int i) const {
  if (!bends(c, i)) return Vec<3>::Zero();
  Bend bend(c, i);
  bend.set_rates(c, i);
  const Vec<3> M = at(c, i), turned = bend.K_rate - bend.spin.cross(bend.K);
  const double thins = 1.5 * bend.strain_rate;
  return modulus(set_, bend.volume_by_length) / bend.l * (turned - thins * bend.K) - (thins + 1) * M +
         bend.spin.cross(M);
}

Vec<3> BendingMoment::elastic(const Chain<3>& c, int i) const {
  if (!bends(c, i)) return Vec<3>::Zero();
  const Bend bend(c, i);
  return modulus(set_, bend.volume_by_length) / bend.l * bend.K;
}

Vec<3> Bending::force(const Chain<3>& c, int e) const {
  const Vec<3> t = tangent(c, e), step = moment_.at(c, e + 1) - moment_.at(c, e);
  return c.inverse_length[e] * (step - t * t.dot(step));
}

void Bending::add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const {
  Vec<3> below = rows.first > 0 ? force(c, rows.first - 1) : Vec<3>(Vec<3>::Zero());
  for (int i = rows.first; i < rows.last; ++i) {
    const Vec<3> above = force(c, i);
    a.row(i) += c.inverse_mass[i] * (below - above).transpose().array();
    below = above;
  }
}

Column BendingColumn::column() const {
  const auto& s = moment_.setting();
  constexpr double small_bend = 0.25;  // K
  return {.name = std::string("bending_") + "xyz"[component_],
          .unit = "g cm2 s-2",
          .scale = s.mass_unit,
          .small = small_bend * modulus(s, 1 / s.section.l_step) / s.section.l_step,
          .of_bead = true};
}

void BendingColumn::set(const Chain<3>& c, int, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const {
  for (int i = rows.first; i < rows.last; ++i) rate[i] = moment_.rate(c, i)[component_];
}

}  // namespace treejet
