#include "core/jet/noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/jet/scales.hpp"
#include "core/jet/stiffness.hpp"

namespace treejet {

namespace {

/// JETSPIN's, already in units of tau^-3 L_0^2.
double diffusivity_in_air(const Parameters& p, const Scales& s) {
  const double drag = 0.65 * std::numbers::pi * p.air_density * std::pow(2 / p.air_viscosity, -0.81) *
                      std::pow(s.l_step, 0.095) * std::pow(p.nozzle_cross, 0.19) / s.mass;
  return p.airdrag_amplitude * drag * s.time * s.time * s.time / (s.length * s.length);
}

double clock_interval(const Parameters& p) {
  constexpr int intervals = 20;
  const Stiffness rates = stiffness(p);
  return std::min(rates.relaxation, rates.bead_interval) / intervals;
}

}  // namespace

bool is_random(const Parameters& p) {
  return (p.noise && p.noise_diffusivity.value_or(0) > 0) || (in_air(p) && p.airdrag_amplitude > 0);
}

Noise noise(const Parameters& p) {
  const Scales s = scales(p);
  Noise n;
  if (p.noise) {
    const double diffusivity = p.noise_diffusivity.value_or(0);
    n.diffusivity = diffusivity / (s.velocity * s.velocity / s.time);
    if (p.noise_variance) n.friction = diffusivity / *p.noise_variance * s.time;
  }
  if (in_air(p)) n.diffusivity_in_air = diffusivity_in_air(p, s);
  n.interval = p.noise_interval.value_or(clock_interval(p)) / s.time;
  n.seed = p.seed;
  return n;
}

}  // namespace treejet
