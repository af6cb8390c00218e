#pragma once
/// Giesekus' law: dumbbells whose mobility depends on their conformation, so that they thin and their stress
/// stays finite in any steady extension. Relaxation is
///
///     dA/dt = ... - (A - 1) - alpha (A - 1)^2      (along and across the element),
///     sigma = (A_xx - A_rr) / 3 ,
///
/// hence, with h = ln A_rr ,
///
///     dsigma/dt = (A_rr + 2 sigma) r - sigma (1 + alpha (3 sigma + 2 A_rr - 2)) ,
///     dh/dt     = - r - (1 - 1/A_rr) - alpha (A_rr - 2 + 1/A_rr) .
///
/// alpha is the mobility factor; 0 gives Oldroyd's law B. Scaled as forces/terms/laws/element_law.hpp says.
/// Source: Giesekus, J. Non-Newtonian Fluid Mech. 11 (1982) 69.

#include "forces/terms/laws/element_law.hpp"

namespace treejet {

struct Giesekus {
  static constexpr std::string_view name = "Giesekus stress";
  static constexpr bool smooth = true;

  double alpha;

  Column column() const { return {.name = "log_radial_conformation", .unit = "1"}; }

  ElementState rates(double r, const ElementState& z) const {
    const double sigma = z.stress, A_rr = std::exp(z.column);
    return {(A_rr + 2 * sigma) * r - sigma * (1 + alpha * (3 * sigma + 2 * A_rr - 2)),
            -r - (1 - 1 / A_rr) - alpha * (A_rr - 2 + 1 / A_rr)};
  }

  StressDerivative derivative(double r, const ElementState& z) const {
    const double sigma = z.stress, A_rr = std::exp(z.column);
    StressDerivative d;
    d.by_strain_rate << A_rr + 2 * sigma, -1;
    d.by_state << 2 * r - 1 - alpha * (6 * sigma + 2 * A_rr - 2), A_rr * (r - 2 * alpha * sigma),  //
        0, -1 / A_rr - alpha * (A_rr - 1 / A_rr);
    return d;
  }
};

}  // namespace treejet
