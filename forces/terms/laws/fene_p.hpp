#pragma once
/// The FENE-P law: dumbbells of finite length L, in Peterlin's closure,
///
///     f = (L^2 - 3) / (L^2 - A_xx - 2 A_rr) ,      dA/dt = ... - (f A - 1) ,      sigma = f (A_xx - A_rr) /
///     3 .
///
/// With sigma and g = ln f for the two components of A and b = (L^2 - 3) / 3 these are, exactly,
///
///     dg/dt     = ( 2 r sigma - (1 + b) f (f - 1) ) / b ,
///     dsigma/dt = (f A_rr + 2 sigma) r - f sigma + sigma dg/dt ,      f A_rr = 1 + (1 + b) (f - 1) - sigma .
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

  /// A small error of g is one of A_rr times 1 + b.
  Column column() const { return {.name = "log_spring_factor", .unit = "1", .small = 1 / (1 + b)}; }

  ElementState rates(double r, const ElementState& z) const {
    const double sigma = z.stress, f = std::exp(z.column), radial = f_A_rr(z), g_rate = column_rate(r, z);
    return {(radial + 2 * sigma) * r - f * sigma + sigma * g_rate, g_rate};
  }

  StressDerivative derivative(double r, const ElementState& z) const {
    const double sigma = z.stress, f = std::exp(z.column);
    const double g_rate_by_g = -(1 + b) * f * (2 * f - 1) / b;
    StressDerivative d;
    d.by_strain_rate << f_A_rr(z) + 2 * sigma + 2 * sigma * sigma / b, 2 * sigma / b;
    d.by_state << r - f + column_rate(r, z) + 2 * r * sigma / b,  //
        f * (1 + b) * r - f * sigma + sigma * g_rate_by_g,        //
        2 * r / b, g_rate_by_g;
    return d;
  }

 private:
  /// f - 1 by expm1: between long dumbbells and none it is all that is left of b.
  double f_A_rr(const ElementState& z) const { return 1 + (1 + b) * std::expm1(z.column) - z.stress; }
  double column_rate(double r, const ElementState& z) const {
    return (2 * r * z.stress - (1 + b) * std::exp(z.column) * std::expm1(z.column)) / b;
  }
};

}  // namespace treejet
