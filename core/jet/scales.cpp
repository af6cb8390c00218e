#include "core/jet/scales.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace treejet {

namespace {
double section(const Parameters& p) {
  return std::numbers::pi * p.nozzle_cross * p.nozzle_cross;
}

double charge_density(const Parameters& p) {
  constexpr double litre = 1000;  // cm^3
  return p.units == Units::real ? p.density_charge * statcoulomb_per_coulomb / litre : p.density_charge;
}

/// That of a component of the external field, over the collector distance.
double potential(const Parameters& p, std::size_t component) {
  const double axial = component == 0 ? p.external_potential : 0;
  const double potential = p.field_vector.empty() ? axial : p.field_vector[component];
  return p.units == Units::real ? potential / volt_per_statvolt : potential;
}
}  // namespace

double inlet_velocity(const Parameters& p) {
  return p.feed == Feed::flow ? p.flow_rate.value_or(0) / section(p) : p.nozzle_velocity;
}

int initial_elements(const Parameters& p) {
  return p.points ? *p.points : static_cast<int>(std::lround(p.initial_length / *p.resolution));
}

Scales scales(const Parameters& p) {
  Scales s;
  s.l_step = p.initial_length / initial_elements(p);
  const double bead_volume = section(p) * s.l_step;
  s.mass = p.density_mass * bead_volume;
  s.charge = charge_density(p) * bead_volume;
  s.stress = p.elastic_modulus;
  s.time = p.viscosity / p.elastic_modulus;
  s.length = s.charge == 0 ? s.l_step : std::abs(s.charge) / std::sqrt(section(p) * s.stress);
  s.velocity = s.length / s.time;
  return s;
}

Groups groups(const Parameters& p) {
  const Scales s = scales(p);
  const double acceleration = s.length / (s.time * s.time);
  Groups g;
  g.Q = s.charge * s.charge / (s.length * s.length) / (s.mass * acceleration);
  g.V = s.charge * potential(p, 0) / p.collector_distance / (s.mass * acceleration);
  g.F_ve = section(p) * s.stress / (s.mass * acceleration);
  g.A = p.surface_tension * section(p) / s.length / (s.mass * acceleration);
  g.F_g = p.gravity ? standard_gravity / acceleration : 0;
  g.K_s = p.perturb ? p.perturb_frequency * s.time : 0;
  g.H = p.collector_distance / s.length;
  g.L_step = s.l_step / s.length;
  return g;
}

std::array<double, 3> field_groups(const Parameters& p) {
  const Scales s = scales(p);
  std::array<double, 3> V;
  for (std::size_t k = 0; k < 3; ++k)
    V[k] = s.charge * potential(p, k) / p.collector_distance / (s.mass * (s.length / (s.time * s.time)));
  return V;
}

std::array<double, 3> magnetic_groups(const Parameters& p) {
  const Scales s = scales(p);
  const double turn = s.charge / s.mass * s.time / speed_of_light;
  std::array<double, 3> M{};
  for (std::size_t k = 0; k < std::min(M.size(), p.magnetic_field.size()); ++k)
    M[k] = turn * (p.units == Units::real ? gauss_per_tesla : 1) * p.magnetic_field[k];
  return M;
}

double turn_rate(const Parameters& p) {
  const std::array<double, 3> M = magnetic_groups(p);
  return std::hypot(M[0], M[1], M[2]) / scales(p).time;
}

Gas air(const Parameters& p) {
  const Scales s = scales(p);
  const double volume = s.length * s.length * s.length, viscosity = s.length * s.velocity;
  return {p.air_density * volume / s.mass, p.air_viscosity / viscosity, p.air_velocity / s.velocity};
}

}  // namespace treejet
