#pragma once
/// The FENE-P law: dumbbells of finite length L, in Peterlin's closure,
///
///     f = (L^2 - 3) / (L^2 - A_xx - 2 A_rr) ,      dA/dt = ... - (f A - 1) ,      sigma = f (A_xx - A_rr) /
///     3 .
///
/// With sigma and g = ln f for the two components of A and b = (L^2 - 3) / 3 these are, exactly,
///
///     dg/dt     = ( 2 r sigma - (1 + b) f (f - 1) ) / b ,
///     dsigma/dt = (f A_rr + 2 sigma) r - f sigma + sigma dg/dt ,      f A_rr = f (1 + b) - b - sigma .
///
/// Any finite g is a dumbbell shorter than L, so that no step leads beyond it, and nothing is singular. For L
/// going to infinity this is Oldroyd's law B; in fast steady extension sigma = 2 L^2 / 3 r. Scaled as
/// forces/terms/laws/element_law.hpp says. Source: Bird, Dotson, Johnson, J. Non-Newtonian Fluid Mech. 7
/// (1980) 213; the change of variables is ours.

#include "forces/terms/laws/element_law.hpp"

namespace treejet {

struct FeneP {
  static constexpr std::string_view name = "FENE-P stress";
  static constexpr bool smooth = true;

  double b;

  static FeneP of_length(double L) { return {(L * L - 3) / 3}; }

  Column column() const { return {.name = "log_spring_factor", .unit = "1"}; }

  ElementState rates(double r, const ElementState& z) const {
    const double sigma = z.stress, f = std::exp(z.column);
    const double g_rate = (2 * r * sigma - (1 + b) * f * (f - 1)) / b;
    return {(f * (1 + b) - b + sigma) * r - f * sigma + sigma * g_rate, g_rate};
  }

  StressDerivative derivative(double r, const ElementState& z) const {
    const double sigma = z.stress, f = std::exp(z.column);
    const double g_rate = (2 * r * sigma - (1 + b) * f * (f - 1)) / b,
                 g_rate_by_g = -(1 + b) * f * (2 * f - 1) / b;
    StressDerivative d;
    d.by_strain_rate << f * (1 + b) - b + sigma + 2 * sigma * sigma / b, 2 * sigma / b;
    d.by_state << r - f + g_rate + 2 * r * sigma / b, f * (1 + b) * r - f * sigma + sigma * g_rate_by_g,  //
        2 * r / b, g_rate_by_g;
    return d;
  }
};

}  // namespace treejet
