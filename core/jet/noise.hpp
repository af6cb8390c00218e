#pragma once
/// Noise: each component of the velocity of a bead of mass m is moved by
///
///     dv = - g v dt + b dW ,    b^2 = 2 (D + D_air / m) ,    g = D / variance ,
///
/// W a Wiener process of its own. D and the variance are those of `noise`; without a variance there is no
/// friction. D_air is that of JETSPIN's `airdrag amplitude` A,
///
///     D_air = A (0.65 pi rho_a (2 / nu_a)^-0.81 l_step^0.095 a_0^0.19 / m_bead) tau^3 / L_0^2 ,
///
/// the bracket a number of CGS units whose dimension JETSPIN lets go. Held bead and nozzle feel none. Scaled;
/// m is 1 for an initial bead.
///
/// With a scheme that takes its steps itself the noise is an acceleration that is constant over the intervals
/// of a fixed clock (forces/terms/random_force.hpp), with `integrator sra1` it is white
/// (integrators/schemes/sra1.hpp). Source: JETSPIN 1.21 and 2.0 beta.

#include <cstdint>

#include "core/jet/parameters.hpp"

namespace treejet {

struct Noise {
  double diffusivity = 0, diffusivity_in_air = 0;
  double friction = 0;  ///< g
  double interval = 0;  ///< of the clock
  int seed = 1;

  double squared_amplitude(double inverse_mass) const {
    return 2 * (diffusivity + diffusivity_in_air * inverse_mass);
  }
};

/// Whether anything is random.
bool is_random(const Parameters& p);

/// By default the clock has 20 intervals in the relaxation time and in the time between two beads.
Noise noise(const Parameters& p);

}  // namespace treejet
