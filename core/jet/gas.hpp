#pragma once
/// The gas around the jet and what it does to a thin cylinder that moves through it.
///
/// Per length of a cylinder of radius a, speed s along or across its axis, Re = 2 a s / nu:
///
///     along    pi a rho c_f s^2 ,   c_f = 0.65 Re^-0.81
///     across      a rho C_n s^2 ,   C_n = 1.18 + 6.8 Re^-0.89 + 1.96 Re^-0.5 - 4e-4 Re / (1 + 3.64e-7 Re^2)
///
/// c_f: Ziabicki, Fundamentals of Fibre Formation (1976), as JETSPIN has it. C_n: Sucker and Brauer, Waerme-
/// und Stoffuebertragung 8 (1975) 149, for 1e-4 < Re < 2e5; below, the force is proportional to the speed
/// from there on, as creeping flow has it. Any consistent units.

namespace treejet {

struct Gas {
  double density, viscosity;  ///< kinematic
  double velocity;            ///< uniform, along x
};

/// Force over speed, and how the force grows with the speed: d ln(force) / d ln(speed).
struct Resistance {
  double value, exponent;

  double by_speed() const { return exponent * value; }  ///< d(force) / d(speed)
};

Resistance along(const Gas& gas, double radius, double speed);
Resistance across(const Gas& gas, double radius, double speed);

}  // namespace treejet
