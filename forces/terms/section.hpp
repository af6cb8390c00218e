#pragma once
/// The section of an element: its volume is conserved, pi a^2 l = pi a_0^2 l_step V (V = 1 as a bead leaves
/// the nozzle). Scaled.

namespace treejet {

struct Section {
  double radius, l_step;  ///< of an element as it leaves the nozzle

  /// Of an element of volume V and length l, given V / l.
  double squared_radius(double volume_by_length) const { return radius * radius * l_step * volume_by_length; }
};

}  // namespace treejet
