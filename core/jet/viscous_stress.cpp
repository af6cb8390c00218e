#include "core/jet/viscous_stress.hpp"

#include "core/jet/scales.hpp"

namespace treejet {

double small_strain_rate(const Parameters& p) {
  constexpr double part = 0.1;
  return p.small_strain_rate.value_or(part / scales(p).time);
}

double scaled_consistency(const Parameters& p) {
  return p.hb_consistency * std::pow(scales(p).time, 1 - p.hb_index);
}

ViscousStress viscous_stress(const Parameters& p) {
  if (stress_law(p) == StressLawKind::kelvin_voigt) return {.consistency = 1};
  if (stress_law(p) == StressLawKind::power_law)
    return {scaled_consistency(p), p.hb_index, small_strain_rate(p) * scales(p).time};
  return {.consistency = p.solvent_viscosity / p.viscosity};
}

}  // namespace treejet
