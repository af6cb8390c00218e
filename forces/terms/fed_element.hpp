#pragma once
/// The youngest element of a jet that is fed by a given flow (core/jet/feed_by_flow.hpp): a control volume
/// that grows, and the bead held in its middle.
///
/// Of bead n-1 (mass m, velocity v) and the nozzle's fluid (velocity v_0), the held bead has the mass
/// s = V - 1 and the velocity (v + v_0) / 2. It is no piece of fluid: fluid flows through the middle of the
/// chord, half of what is fed, and gains velocity on its way, so that the acceleration there is
///
///     a_h = (dv/dt + dv_0/dt) / 2 + (v - v_0) Vdot / (2 V) .
///
/// Bound to the chord the held bead hands half of f_h - s a_h, f_h the forces on it, down to bead n-1, half
/// up to the nozzle:
///
///     (m + s/4) dv/dt = f + f_h / 2 - s/4 ( dv_0/dt + (v - v_0) Vdot / V ) .
///
/// The momentum m v + s (v + v_0) / 2 + v_0 / 2 of these and the nozzle's half bead so changes by the forces,
/// the momentum Vdot v_0 of what is fed, and what the nozzle bears, and by nothing else. Fresh fluid is
/// without stress and as at birth in every added column c (core/jet/columns.hpp); mixed with what is in the
/// element,
///
///     d sigma/dt = ... - sigma Vdot / V ,      dc/dt = ... - (c - c_at_birth) Vdot / V .
///
/// Scaled. Source: balance of momentum with the test function that is linear on the element.

#include "core/jet/local_jacobian.hpp"
#include "core/jet/nozzle.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class FedElement {
 public:
  explicit FedElement(const Nozzle<D>& nozzle) : nozzle_(nozzle) {}

  /// How bead n-1 answers to an acceleration that forces on itself would give it, and to one of a held bead
  /// that is free.
  struct Shares {
    double own, held;
  };
  Shares shares(const Chain<D>& c) const;

  /// Turns the slope of row n-1 as left to itself into that of the bound one; `of_held` = f_h / s.
  void bind(const Chain<D>& c, const Vec<D>& of_held, State<D>& slope) const;

  /// The same for the answer, forces on the held bead left out: those by their place are small or not local.
  void bind(const Chain<D>& c, LocalJacobian<D>& J) const;

 private:
  /// Vdot / V.
  double renewal(const Chain<D>& c) const { return nozzle_.feed().flow() / (1 + c.held_mass); }

  Nozzle<D> nozzle_;
};

}  // namespace treejet
