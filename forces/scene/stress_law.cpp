#include "forces/scene/stress_law.hpp"

#include <stdexcept>

#include "core/jet/scales.hpp"
#include "core/jet/stiffness.hpp"
#include "core/jet/viscous_stress.hpp"
#include "forces/terms/evaporation.hpp"
#include "forces/terms/laws/elastoviscoplastic.hpp"
#include "forces/terms/laws/fene_p.hpp"
#include "forces/terms/laws/giesekus.hpp"
#include "forces/terms/laws/inelastic.hpp"
#include "forces/terms/laws/kelvin_voigt.hpp"
#include "forces/terms/laws/oldroyd_b.hpp"

namespace treejet {

namespace {

template <int D, class Law>
std::unique_ptr<StressLaw<D>> element_law(const Law& law) {
  return std::make_unique<ElementLaw<D, Law>>(law);
}

template <int D>
std::unique_ptr<StressLaw<D>> jetspin_herschel_bulkley(const Parameters& p) {
  const Scales s = scales(p);
  return std::make_unique<HerschelBulkley<D>>(p.yield_stress / s.stress, scaled_consistency(p), p.hb_index,
                                              small_strain_rate(p) * s.time);
}

}  // namespace

bool is_jetspin_herschel_bulkley(const Parameters& p) {
  return stress_law(p) == StressLawKind::maxwell && (p.hbfluid || p.yield_stress > 0);
}

template <int D>
std::unique_ptr<StressLaw<D>> stress_law_of(const Parameters& p) {
  using enum StressLawKind;
  const StressLawKind kind = stress_law(p);
  if (is_jetspin_herschel_bulkley(p)) return jetspin_herschel_bulkley<D>(p);
  if (p.evaporation) return std::make_unique<DryingStress<D>>(Evaporation(p), kind == maxwell);
  switch (kind) {
    case maxwell:
      return std::make_unique<Maxwell<D>>();
    case kelvin_voigt:
      return element_law<D>(KelvinVoigt{});
    case oldroyd_b:
      return element_law<D>(OldroydB{});
    case giesekus:
      return element_law<D>(Giesekus{p.mobility.value()});
    case fene_p:
      return element_law<D>(FeneP::of_length(p.extensibility.value()));
    case power_law:
      return element_law<D>(Inelastic{});
    case herschel_bulkley:
      return element_law<D>(
          Elastoviscoplastic{p.yield_stress / scales(p).stress, scaled_consistency(p), p.hb_index});
  }
  throw std::logic_error("no such stress law");
}

template std::unique_ptr<StressLaw<1>> stress_law_of<1>(const Parameters&);
template std::unique_ptr<StressLaw<3>> stress_law_of<3>(const Parameters&);

}  // namespace treejet
