#include "core/deck/relations.hpp"

#include <fmt/format.h>

#include "core/jet/scales.hpp"

namespace treejet {

namespace {

class OfFluid : Relations {
 public:
  explicit OfFluid(const Relations& all) : Relations(all) {}

  void check() {
    fluid();
    evaporation();
  }

 private:
  void fluid() {
    using enum StressLawKind;
    const StressLawKind law = stress_law(p_);
    const bool of_jetspin = law == maxwell, yields = of_jetspin || law == herschel_bulkley;
    const bool thins = p_.hbfluid || law == herschel_bulkley || law == power_law;
    error(p_.kvfluid && is_given("stress law") && p_.stress_law != kelvin_voigt, {"kvfluid", "stress law"},
          "expected stress law kelvin-voigt, which is the same, or none");
    error(p_.hbfluid && !of_jetspin, {"hbfluid", "stress law", "kvfluid"},
          "expected stress law maxwell, to which it adds; stress law herschel-bulkley is a law of its own");
    error(p_.yield_stress > 0 && !yields, {"yield stress", "stress law", "kvfluid"},
          "expected stress law maxwell or herschel-bulkley: the others do not yield");
    for (const char* detail : {"hbfluid consistency", "hbfluid index"}) {
      error(p_.hbfluid && !is_given(detail), {"hbfluid"},
            fmt::format("expected {} to be given, too", detail));
      error(thins && !p_.hbfluid && !is_given(detail), {"stress law"},
            fmt::format("expected {} to be given, too", detail));
      error(!thins && is_given(detail), {detail, "hbfluid"}, "expected hbfluid yes to be given, too");
    }
    error(law == herschel_bulkley && p_.yield_stress == 0, {"stress law", "yield stress"},
          "expected yield stress to be given, too; stress law power-law has none");
    const auto belongs = [&](StressLawKind owner, const char* detail, const char* name) {
      error(law == owner && !is_given(detail), {"stress law"},
            fmt::format("expected {} to be given, too", detail));
      error(law != owner && is_given(detail), {detail, "stress law"},
            fmt::format("expected stress law {}", name));
    };
    belongs(giesekus, "stress law mobility", "giesekus");
    belongs(fene_p, "stress law extensibility", "fene-p");
    error(p_.solvent_viscosity > 0 && (law == kelvin_voigt || law == power_law),
          {"solvent viscosity", "stress law", "kvfluid"},
          "expected none: viscosity is all of the viscous stress of this stress law");
    error(law == power_law && p_.nozzle_stress != 0, {"nozzle stress", "stress law"},
          "expected none: the stress of a power-law fluid follows from its strain rate");
    error(law == fene_p && p_.nozzle_stress != 0, {"nozzle stress", "stress law"},
          "expected none: FENE-P dumbbells leave the nozzle at rest");
    error(law == giesekus || law == oldroyd_b ? p_.nozzle_stress < -p_.elastic_modulus / 3 : false,
          {"nozzle stress", "stress law"},
          "expected at least minus a third of elastic modulus: less has no conformation");
    note(is_given("small strain rate") && !p_.hbfluid && p_.yield_stress == 0 && law != power_law,
         "small strain rate", "no effect without a yield stress, hbfluid yes or stress law power-law");
    note(is_given("small strain rate") && law == herschel_bulkley, "small strain rate",
         "no effect: in stress law herschel-bulkley no sign changes with the strain rate");
  }

  void evaporation() {
    const bool dries = p_.evaporation, by_vapour = p_.evaporation_model == EvaporationModel::vapour;
    only_with(dries, "evaporation yes",
              {"evaporation model", "evaporation polymer frac", "evaporation solvent",
               "evaporation temperature", "evaporation humidity", "evaporation diffusivity",
               "evaporation airviscosity", "evaporation vapour density", "evaporation chi",
               "evaporation bconstant", "evaporation mconstant", "evaporation tconstant"});
    if (!dries) return;
    error(!is_given("evaporation polymer frac"), {"evaporation"},
          "expected evaporation polymer frac to be given, too");
    const StressLawKind law = stress_law(p_);
    law_without_extras("evaporation", law == StressLawKind::maxwell || law == StressLawKind::kelvin_voigt,
                       "stress law maxwell or kelvin-voigt", "how the others thicken is not modelled");
    const bool other = p_.solvent != SolventName::water;
    for (const char* detail : {"evaporation solvent", "evaporation vapour density", "evaporation chi"})
      error(!by_vapour && is_given(detail), {detail, "evaporation model"},
            "expected evaporation model vapour");
    error(by_vapour && other && !p_.vapour_diffusivity, {"evaporation solvent"},
          "expected evaporation diffusivity to be given, too, of its vapour in air");
    note(by_vapour && other && is_given("evaporation humidity"), "evaporation humidity",
         "no effect: air holds no vapour of this solvent far from the jet");
    constexpr double boiling = 323.15;  // Lowe's polynomial ends there
    error(!other && p_.temperature > boiling, {"evaporation temperature"},
          "expected at most 323.15 for water");
    note(!by_vapour, "evaporation",
         "JETSPIN's law takes the ratio of pressures of vapour and air for that of the densities of vapour "
         "and fluid: "
         "water leaves about 1330 times too fast; evaporation model vapour conserves mass");
  }
};

}  // namespace

void check_fluid(const Relations& all) {
  OfFluid(all).check();
}

}  // namespace treejet
