#pragma once
/// Characteristic scales and dimensionless groups: the only place where units change.
///
/// Inside the program every quantity is divided by its scale, so that an initial bead has mass 1 and
/// charge 1. Source: paper, Sec. "Dimensionless quantities" and its table. The groups are those of a bead
/// with m = q = 1; the terms divide by the scaled mass and multiply by the scaled charge of each bead.
/// Without charge the paper's L_0 vanishes; the length scale is then l_step and Q = V = 0.

#include <array>

#include "core/jet/gas.hpp"
#include "core/jet/parameters.hpp"

namespace treejet {

struct Scales {
  double l_step;    ///< discretisation length, cm
  double length;    ///< L_0 = l_step sqrt(pi a_0^2 rho_q^2 / G), cm, whatever the sign of rho_q
  double time;      ///< tau = mu / G, s
  double stress;    ///< G, g/(cm s^2)
  double mass;      ///< of a bead, rho pi a_0^2 l_step, g
  double charge;    ///< of a bead, rho_q pi a_0^2 l_step, statC
  double velocity;  ///< L_0 / tau, cm/s
};

struct Groups {
  double Q;       ///< Coulomb: q^2 mu^2 / (L_0^3 m G^2)
  double V;       ///< external field: q V_0 mu^2 / (m h L_0 G^2)
  double F_ve;    ///< viscoelastic: pi a_0^2 mu^2 / (m L_0 G)
  double A;       ///< surface tension: alpha pi a_0^2 mu^2 / (m L_0^2 G^2)
  double F_g;     ///< gravity: g mu^2 / (L_0 G^2); 0 without gravity
  double K_s;     ///< nozzle: omega mu / G; 0 without perturbation
  double H;       ///< collector distance / L_0
  double L_step;  ///< l_step / L_0
};

/// Speed of light in cm/s over 10: statC per coulomb; 299.792458 V are one statV.
constexpr double statcoulomb_per_coulomb = 2997924580.0;
constexpr double volt_per_statvolt = 299.792458;
constexpr double speed_of_light = 2.99792458e10;  ///< cm/s
constexpr double gauss_per_tesla = 1e4;
constexpr double standard_gravity = 980.665;  ///< cm/s^2

Scales scales(const Parameters& p);
Groups groups(const Parameters& p);

/// The groups V of the three components of the external field; the first is that of `groups`.
std::array<double, 3> field_groups(const Parameters& p);

/// The groups M of the three components of the magnetic field, q B mu / (m c G); zeros without one.
std::array<double, 3> magnetic_groups(const Parameters& p);

/// The angle a time by which a bead turns in the magnetic field, |q B / (m c)|, 1/s.
double turn_rate(const Parameters& p);

/// The air, scaled; it exerts forces of the scaled equations of motion.
Gas air(const Parameters& p);

/// Velocity of the fluid at the nozzle, cm/s: as given, or that of the flow through its section.
double inlet_velocity(const Parameters& p);

/// Number of elements of the initial jet.
int initial_elements(const Parameters& p);

}  // namespace treejet
