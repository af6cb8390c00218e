#pragma once
/// The part of an element's stress that follows its strain rate r at once, scaled:
///
///     sigma = K e^(n-1) r ,      e = sqrt(r^2 + r_0^2) .
///
/// With n = 1 it is Newton's: the solvent of a polymer solution, or the dashpot of a Kelvin-Voigt element. A
/// power-law fluid (Ostwald, de Waele) has no other stress. r_0, a strain rate far below those of the jet,
/// keeps a thinning fluid's viscosity finite and the derivatives smooth where an element turns from
/// stretching to shrinking.
///
/// As everywhere in this model viscosities are elongational: stress over strain rate, for a Newtonian fluid
/// three times the shear viscosity.

#include <cmath>

#include "core/jet/parameters.hpp"

namespace treejet {

struct ViscousStress {
  double consistency = 0, index = 1, small_rate = 0;

  bool acts() const { return consistency != 0; }

  double operator()(double rate) const { return viscosity(rate) * rate; }

  /// d sigma / dr
  double derivative(double rate) const {
    const double e2 = rate * rate + small_rate * small_rate, bend = e2 > 0 ? rate * rate / e2 : 0;
    return viscosity(rate) * (1 + (index - 1) * bend);
  }

 private:
  double viscosity(double rate) const {
    return index == 1 ? consistency : consistency * std::pow(std::hypot(rate, small_rate), index - 1);
  }
};

/// That of a deck's fluid; none acts in Maxwell's.
ViscousStress viscous_stress(const Parameters& p);

/// r_0 in 1/s: the deck's, or a tenth of the rate of relaxation.
double small_strain_rate(const Parameters& p);

/// K of a deck's `hbfluid consistency`, which is in units of the viscosity with strain rates in 1/s.
double scaled_consistency(const Parameters& p);

}  // namespace treejet
