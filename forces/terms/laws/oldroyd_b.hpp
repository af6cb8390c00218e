#pragma once
/// Oldroyd's law B: Hookean dumbbells in a solvent. Their conformation follows the element and relaxes,
///
///     dA_xx/dt = 2 r A_xx - (A_xx - 1) ,   dA_rr/dt = - r A_rr - (A_rr - 1) ,   sigma = (A_xx - A_rr) / 3 ,
///
/// hence, with h = ln A_rr ,
///
///     dsigma/dt = (A_rr + 2 sigma) r - sigma ,      dh/dt = - r - (1 - 1/A_rr) .
///
/// Maxwell's equation is what is left of it at small strains. Steady extension has a finite stress below r =
/// 1/2 only; above, it grows as exp((2 r - 1) t). The solvent pulls by itself
/// (forces/terms/viscous_tension.hpp); without one this is the upper-convected Maxwell fluid. Scaled as
/// forces/terms/laws/element_law.hpp says. Source: Oldroyd, Proc. R. Soc. A 200 (1950) 523.

#include "forces/terms/laws/element_law.hpp"

namespace treejet {

struct OldroydB {
  static constexpr std::string_view name = "Oldroyd-B stress";
  static constexpr bool smooth = true;

  Column column() const { return {.name = "log_radial_conformation", .unit = "1"}; }

  ElementState rates(double r, const ElementState& z) const {
    const double sigma = z.stress, A_rr = std::exp(z.column);
    return {(A_rr + 2 * sigma) * r - sigma, -r - (1 - 1 / A_rr)};
  }

  StressDerivative derivative(double r, const ElementState& z) const {
    const double sigma = z.stress, A_rr = std::exp(z.column);
    StressDerivative d;
    d.by_strain_rate << A_rr + 2 * sigma, -1;
    d.by_state << 2 * r - 1, A_rr * r, 0, -1 / A_rr;
    return d;
  }
};

}  // namespace treejet
