#include "core/jet/stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/jet/scales.hpp"
#include "core/jet/schemes.hpp"
#include "core/jet/viscous_stress.hpp"

namespace treejet {

namespace {

/// Above this many steps a bead the additive scheme costs less, though it evaluates every term at every
/// stage.
constexpr double bound_by_stability = 20;

/// dT/dl at the most.
double self_field_stiffness(const Parameters& p, const Scales& s) {
  if (p.self_field == SelfField::point) return 0;
  const double g = std::log(2 * s.l_step / p.nozzle_cross) - std::numbers::egamma;
  return s.charge * s.charge / (s.l_step * s.l_step * s.l_step) * (2 * std::abs(g) + 4.5);
}

/// The slope of the stress at rest over the modulus, where a rounded sign makes it steeper.
double steepness(const Parameters& p, const Scales& s) {
  if (stress_law(p) != StressLawKind::maxwell || (p.yield_stress == 0 && !p.hbfluid)) return 1;
  const double rate = small_strain_rate(p) * s.time;
  return p.yield_stress / s.stress / rate + scaled_consistency(p) * std::pow(rate, p.hb_index - 1);
}

/// What is as viscous as this at the strain rates of the jet, or at rest.
double viscous_damping(const Parameters& p, const Scales& s, double strain_rate) {
  const ViscousStress viscous = viscous_stress(p);
  const double slope = std::max(viscous.derivative(0), viscous.derivative(strain_rate * s.time));
  return 4 * slope * p.viscosity / (p.density_mass * s.l_step * s.l_step);
}

double fastest_rate(const Parameters& p, const Scales& s) {
  const double stiff = std::max(steepness(p, s), 1.0) * p.elastic_modulus;
  const double wave = 2 / s.l_step * std::sqrt(stiff / p.density_mass), damping = 1 / s.time;
  const double omega = std::sqrt(wave * wave + 4 * self_field_stiffness(p, s) / s.mass);
  const double overdamped = damping * damping - 4 * omega * omega;
  return overdamped > 0 ? (damping + std::sqrt(overdamped)) / 2 : omega;
}

/// v from the balance in the header, by bisection between rest and free flight.
double speed(const Parameters& p, const Scales& s, double drive) {
  double low = 0, high = std::sqrt(drive / p.density_mass);
  for (int i = 0; i < 100; ++i) {
    const double v = (low + high) / 2, e = v / s.l_step;
    const double resistance = p.density_mass * v * v + p.viscosity * e / (1 + s.time * e);
    (resistance < drive ? low : high) = v;
  }
  return (low + high) / 2;
}

double drag_rate(const Parameters& p, double v, double v_c) {
  if (!in_air(p)) return 0;
  const Gas gas{p.air_density, p.air_viscosity, p.air_velocity};
  const double a = p.nozzle_cross * (v_c > 0 ? std::sqrt(v / v_c) : 1), wind = std::abs(v_c - p.air_velocity);
  const double mass = p.density_mass * std::numbers::pi * a * a,
               axial = along(gas, a, wind).by_speed() / mass;
  return p.drag_model == DragModel::full ? std::max(axial, across(gas, a, wind).by_speed() / mass) : axial;
}

}  // namespace

Stiffness stiffness(const Parameters& p) {
  const Scales s = scales(p);
  const double charge_density = s.charge / s.mass * p.density_mass,
               section = s.mass / p.density_mass / s.l_step;
  const double field_on_element = groups(p).V * s.mass * s.length / (s.time * s.time) / section;
  const double drive = std::max(section * charge_density * charge_density + field_on_element, 0.0);
  const double v = p.feed == Feed::flow ? inlet_velocity(p) : std::max(speed(p, s, drive), p.nozzle_velocity);
  const double work = field_on_element / s.l_step * p.collector_distance / p.density_mass;
  const double drag = drag_rate(p, v, std::sqrt(v * v + std::max(2 * work, 0.0)));
  const double fastest = std::max({fastest_rate(p, s), viscous_damping(p, s, v / s.l_step), drag});
  return {fastest, s.time, std::min(s.l_step / v, p.final_time), drag, turn_rate(p)};
}

Scheme chosen_scheme(const Parameters& p) {
  if (p.integrator != Scheme::automatic) return p.integrator;
  return stiffness(p).stable_steps() > bound_by_stability ? Scheme::kencarp5 : Scheme::verner6;
}

std::string choice_reason(const Parameters& p) {
  if (p.integrator != Scheme::automatic) return "";
  const Stiffness s = stiffness(p);
  const bool stiff = properties(chosen_scheme(p)).implicit;
  return fmt::format(
      "{}: beads follow each other every {:.2g} s, in which an explicit scheme needs {} to be stable",
      stiff ? "stiff" : "not stiff", s.bead_interval,
      s.stable_steps() < 1 ? "no more than one step" : fmt::format("{:.2g} steps", s.stable_steps()));
}

}  // namespace treejet
