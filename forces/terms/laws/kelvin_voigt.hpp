#pragma once
/// A Kelvin-Voigt element: a spring beside a dashpot,
///
///     sigma = G ln(l / l_ref) + mu r ,      r = (1/l) dl/dt .
///
/// The spring's part is the state of the element, dsigma/dt = r scaled by G and mu / G: it never relaxes.
/// l_ref is the length at which an element is released. The dashpot's part pulls by itself
/// (forces/terms/viscous_tension.hpp). JETSPIN integrates the whole stress and drops -r^2 from the derivative
/// of r.

#include "forces/terms/laws/element_law.hpp"

namespace treejet {

struct KelvinVoigt {
  static constexpr std::string_view name = "Kelvin-Voigt stress";
  static constexpr bool smooth = true;

  ElementState rates(double r, const ElementState&) const { return {r, 0}; }

  StressDerivative derivative(double, const ElementState&) const {
    StressDerivative d;
    d.by_strain_rate[0] = 1;
    return d;
  }
};

}  // namespace treejet
