#pragma once
/// A solution that dries: how its solvent leaves an element, and what becomes of its viscosity.
///
/// The fluid has polymer, a part c_0 of its volume at the nozzle, which stays, and solvent of the same
/// density. w is the solvent of an element over its volume at the nozzle, nu = c_0 + w what is left of that
/// volume and of the mass of its bead, c = c_0 / nu the concentration. Through the surface of an element of
/// length l and radius a in air that goes past at speed u the solvent leaves at
///
///     dV_s/dt = - pi D Sh l delta ,   Sh = 0.495 Re^(1/3) Sc^(1/2) ,   Re = 2 a u / nu_a ,   Sc = nu_a / D ,
///
/// D the diffusivity of its vapour in air, nu_a the viscosity of air. By the vapour that air at the surface
/// and far away can hold (`vapour`), with the activity of Flory and Huggins, phi = c the share of polymer,
///
///     delta = rho_v ( (1 - phi) exp(phi + chi phi^2) - humidity ) / rho ,      rho_v = p_s M / (R T) ,
///
/// which conserves mass and ends where the solution is in balance with the air. JETSPIN (`jetspin`) has a
/// ratio of pressures for that of densities, 1330 times too much for water, and stops at c = 0.9, which is an
/// event (integrators/march/march.hpp):
///
///     delta = p_s / p_atmosphere ( 1 - humidity ) .
///
/// Viscosity and relaxation time follow the concentration,
///
///     mu = mu_0 10^(B (c^m - c_0^m)) ,     theta = theta_0 (c / c_0)^t .
///
/// Left out: the cooling of the jet (10 to 20 K for water, which halves the rate), the vapour that coils
/// leave around each other. Source: Yarin, Koombhongse, Reneker, J. Appl. Phys. 89 (2001) 3018; vapour
/// pressures: of water Lowe, J. Appl. Meteorol. 16 (1977) 100, of others Antoine's equation with NIST's
/// constants.

#include <optional>

#include "core/jet/parameters.hpp"

namespace treejet {

class Evaporation {
 public:
  explicit Evaporation(const Parameters& p);

  double polymer() const { return polymer_; }               ///< c_0
  double solvent_at_birth() const { return 1 - polymer_; }  ///< w at the nozzle

  /// What is left of the volume at the nozzle, of a solvent content w.
  double remaining(double w) const { return polymer_ + w; }
  double concentration(double w) const { return polymer_ / remaining(w); }

  /// The solvent content at which drying stops, if it does before all is gone: 0 rate at exactly this value.
  std::optional<double> end() const { return end_; }

  /// delta, for this solvent content.
  double driving(double w) const;

  /// Velocity of the air along x; JETSPIN takes the speed of the jet alone.
  double wind() const { return wind_; }

  /// dw/dt scaled, of an element of scaled length and speed; `volume` at the nozzle, that of an initial
  /// bead 1.
  double rate(double w, double length, double speed, double volume) const;

  double viscosity_ratio(double c) const;   ///< mu / mu_0
  double relaxation_ratio(double c) const;  ///< theta / theta_0

 private:
  double polymer_, activity_scale_, humidity_, chi_;
  bool by_vapour_;
  std::optional<double> end_;
  double coefficient_, least_speed2_, wind_ = 0;
  double B_, m_, t_;
};

/// That of a deck's fluid, if it dries.
inline std::optional<Evaporation> drying(const Parameters& p) {
  return p.evaporation ? std::optional<Evaporation>(p) : std::nullopt;
}

/// Saturated vapour over the pure solvent: pressure in Pa and density in g/cm^3 at a temperature in K.
double vapour_pressure(SolventName solvent, double temperature);
double vapour_density(SolventName solvent, double temperature);

/// Of water vapour in air, cm^2/s.
double water_diffusivity(double temperature);

}  // namespace treejet
