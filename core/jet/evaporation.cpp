#include "core/jet/evaporation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/jet/scales.hpp"

namespace treejet {

namespace {

constexpr double atmosphere = 101325;  ///< Pa
constexpr double gas_constant = 8.314462618;
constexpr double least_speed =
    1;  ///< cm/s: air is never so still that nothing evaporates, nor Re^(1/3) steep

/// log10 of p / bar is  A - B / (T + C) , and g/mol.
struct Liquid {
  double A, B, C, molar_mass;
};

constexpr Liquid liquid(SolventName solvent) {
  switch (solvent) {
    case SolventName::water:
      return {0, 0, 0, 18.015};
    case SolventName::ethanol:
      return {5.24677, 1598.673, -46.424, 46.068};
    case SolventName::dmf:
      return {3.93068, 1337.716, -82.648, 73.094};
    case SolventName::chloroform:
      return {4.20772, 1233.129, -40.953, 119.378};
    case SolventName::acetone:
      return {4.42448, 1312.253, -32.445, 58.079};
  }
  throw std::logic_error("no such solvent");
}

/// Lowe's polynomial, mbar, in degrees Celsius from -50 to 50.
double over_water(double t) {
  constexpr double a[] = {6.107799961,    4.436518521e-1, 1.428945805e-2, 2.650648471e-4,
                          3.031240396e-6, 2.034080948e-8, 6.136820929e-11};
  double p = 0;
  for (int k = 6; k >= 0; --k) p = p * t + a[k];
  return p;
}

}  // namespace

double vapour_pressure(SolventName solvent, double temperature) {
  constexpr double freezing = 273.15, pascal_per_mbar = 100, pascal_per_bar = 1e5;
  if (solvent == SolventName::water) return pascal_per_mbar * over_water(temperature - freezing);
  const Liquid l = liquid(solvent);
  return pascal_per_bar * std::pow(10, l.A - l.B / (temperature + l.C));
}

double vapour_density(SolventName solvent, double temperature) {
  constexpr double per_cubic_metre = 1e-6;
  return vapour_pressure(solvent, temperature) * liquid(solvent).molar_mass / (gas_constant * temperature) *
         per_cubic_metre;
}

double water_diffusivity(double temperature) {
  return 0.211 * std::pow(temperature / 273.15, 1.94);
}

Evaporation::Evaporation(const Parameters& p)
    : polymer_(p.polymer_fraction),
      humidity_(p.solvent == SolventName::water ? p.humidity : 0),
      chi_(p.flory_chi),
      by_vapour_(p.evaporation_model == EvaporationModel::vapour),
      B_(p.viscosity_b),
      m_(p.viscosity_m),
      t_(p.relaxation_t) {
  constexpr double solid = 0.9;  // concentration, of JETSPIN
  // by vapour nothing stops: below 0 the activity is negative, and what a step overshoots comes back
  if (!by_vapour_) end_ = std::min(polymer_ / solid - polymer_, solvent_at_birth());
  activity_scale_ = by_vapour_
                        ? p.vapour_density.value_or(vapour_density(p.solvent, p.temperature)) / p.density_mass
                        : vapour_pressure(SolventName::water, p.temperature) / atmosphere;
  const Scales s = scales(p);
  const double D = p.vapour_diffusivity.value_or(water_diffusivity(p.temperature)),
               nu = p.drying_air_viscosity;
  // pi D Sh l over the volume of an initial bead, at a = a_0, u = the unit of velocity, l = that of length
  coefficient_ = std::numbers::pi * D * 0.495 * std::cbrt(2 * p.nozzle_cross * s.velocity / nu) *
                 std::sqrt(nu / D) * s.length / (s.mass / p.density_mass) * s.time *
                 std::pow(s.l_step / s.length, 1. / 6);  // of the radius, a^2 l = a_0^2 l_step
  if (by_vapour_ && in_air(p)) wind_ = p.air_velocity / s.velocity;
  const double least = std::max(least_speed, inlet_velocity(p)) / s.velocity;
  least_speed2_ = least * least;
}

double Evaporation::driving(double w) const {
  if (!by_vapour_) return w == end_ ? 0 : activity_scale_ * (1 - humidity_);
  if (w <= -polymer_) return 0;
  const double phi = concentration(w), activity = (1 - phi) * std::exp(phi + chi_ * phi * phi);
  return activity_scale_ * (activity - humidity_);
}

/// With a = a_0 sqrt(volume nu l_step / l) the length enters as l^(5/6), the volume as its power 1/6 - 1.
double Evaporation::rate(double w, double length, double speed, double volume) const {
  const double radius2 = volume * std::max(remaining(w), polymer_);  // times l, in units of a_0^2 l_step
  return -coefficient_ * driving(w) * std::pow((speed * speed + least_speed2_) * radius2, 1. / 6) *
         std::pow(length, 5. / 6) / volume;
}

double Evaporation::viscosity_ratio(double c) const {
  return std::pow(10, B_ * (std::pow(c, m_) - std::pow(polymer_, m_)));
}

double Evaporation::relaxation_ratio(double c) const {
  return std::pow(c / polymer_, t_);
}

}  // namespace treejet
