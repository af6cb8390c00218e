#pragma once
/// A Herschel-Bulkley fluid that is rigid, but for its elasticity, below the yield stress s_Y:
///
///     dsigma/dt = r - sgn(sigma) ( max(0, |sigma| - s_Y) / K )^(1/n) .
///
/// In steady extension sigma = s_Y + K r^n; an element under less than s_Y holds its stress for ever. The
/// rate of the stress is continuous, with a kink where the element begins to yield; the sign of the strain
/// rate does not appear. Scaled by G and mu / G. Source: Saramito, J. Non-Newtonian Fluid Mech. 158 (2009)
/// 154, for one element and with the linear (Maxwell's) rate of the stress.

#include <algorithm>

#include "forces/terms/laws/element_law.hpp"

namespace treejet {

struct Elastoviscoplastic {
  static constexpr std::string_view name = "elastoviscoplastic stress";
  static constexpr bool smooth = false;

  double yield, K, index;

  ElementState rates(double r, const ElementState& z) const {
    return {r - std::copysign(std::pow(excess(z) / K, 1 / index), z.stress), 0};
  }

  /// Where a thickening fluid begins to yield its derivative is infinite: there a large one stands in.
  StressDerivative derivative(double, const ElementState& z) const {
    constexpr double least = 1e-12;
    StressDerivative d;
    d.by_strain_rate[0] = 1;
    const double x = std::max(excess(z), least);
    if (std::abs(z.stress) > yield) d.by_state(0, 0) = -std::pow(x / K, 1 / index) / (index * x);
    return d;
  }

 private:
  double excess(const ElementState& z) const { return std::max(0.0, std::abs(z.stress) - yield); }
};

}  // namespace treejet
