#pragma once
/// Whether a scene is stiff: whether the step of an explicit scheme would be bound by stability rather than
/// by accuracy. An estimate from the deck alone, made before the run.
///
/// A chain of elements of length l carries longitudinal waves, damped by relaxation: with omega = 2 / l
/// sqrt(G / rho) and tau = mu / G its fastest rates solve  lambda^2 + lambda / tau + omega^2 = 0 .  They are
/// fastest in the shortest elements, l = l_step, at the nozzle. Elastic (omega tau > 1/2), |lambda| = omega;
/// viscous, |lambda| rises up to 1 / tau. With `self field slender` the charge q of a bead of mass m stiffens
/// its element, at most by  dT/dl = q^2 / l^3 (2 |g| + 9/2)  (forces/terms/slender_self_field.hpp), and
/// omega^2 grows by 4 dT/dl / m. A viscous stress damps at up to 4 mu_s / (rho l^2); the rounded sign of a
/// yield stress makes G steeper at rest. How a polymer hardens is not looked at.
///
/// Air slows a bead down at d(drag)/dv over its mass (core/jet/gas.hpp), the faster the thinner the jet is.
/// In free flight to the collector, where a straight one ends, v_c^2 = v^2 + 2 rho_q V_0 / rho and a = a_0
/// sqrt(v / v_c); bends thin it further.
///
/// Accuracy asks for a few steps a bead. Beads follow each other at l_step / v, where inertia and the Maxwell
/// stress balance what drives the jet, the repulsion of neighbours and the field on one element:
///     rho v^2 + mu e / (1 + tau e) = pi a_0^2 rho_q^2 + rho_q l_step V_0 / h ,      e = v / l_step ;
/// fed by flow, v is that of the flow.

#include <algorithm>
#include <string>

#include "core/jet/parameters.hpp"

namespace treejet {

struct Stiffness {
  double fastest_rate;   ///< |lambda|, 1/s
  double relaxation;     ///< tau, s
  double bead_interval;  ///< l_step / v, s
  double drag_rate;      ///< 1/s, 0 without air
  double turn_rate = 0;  ///< of a bead in a magnetic field, 1/s

  /// Steps a bead to which stability binds an explicit scheme.
  double stable_steps() const {
    constexpr double reach = 4.5;  // largest stable |lambda| h of the explicit pairs, about
    return fastest_rate * bead_interval / reach;
  }

  /// Stress, or motion through the air, that relaxes within the interval of beads cannot be continued in time
  /// over several of them, nor can a circle that is closed in a few: PVP at two rates runs at G times 10
  /// (interval / tau = 3) and breaks down at G times 20 (6.5).
  bool relaxes_between_beads() const {
    return bead_interval > 2 * relaxation || std::max(drag_rate, turn_rate) * bead_interval > 2;
  }
};

Stiffness stiffness(const Parameters& p);

/// The deck's scheme. Where it leaves the choice: Verner's 6(5) pair, at the event rate of the paper's case 3
/// the one with the fewest evaluations for errors of 1e-4 cm; Kennedy and Carpenter's additive one for a
/// stiff scene.
Scheme chosen_scheme(const Parameters& p);

/// Why, as half a sentence; empty if the deck names the scheme.
std::string choice_reason(const Parameters& p);

}  // namespace treejet
