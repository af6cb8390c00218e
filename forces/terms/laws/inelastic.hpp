#pragma once
/// A fluid without elasticity: nothing of its stress is a state of the element. All of it follows the strain
/// rate at once (forces/terms/viscous_tension.hpp).

#include "forces/terms/laws/element_law.hpp"

namespace treejet {

struct Inelastic {
  static constexpr std::string_view name = "power-law stress";
  static constexpr bool smooth = true;

  ElementState rates(double, const ElementState&) const { return {}; }
  StressDerivative derivative(double, const ElementState&) const { return {}; }
};

}  // namespace treejet
