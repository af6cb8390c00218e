#pragma once
/// The section of an element: its volume is conserved, pi a^2 l = pi a_0^2 l_step. Scaled.

namespace treejet {

struct Section {
  double radius, l_step;  ///< of an element as it leaves the nozzle

  double squared_radius(double inverse_length) const { return radius * radius * l_step * inverse_length; }
};

}  // namespace treejet
