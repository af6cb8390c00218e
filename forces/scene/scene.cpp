#include "forces/scene/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/jet/noise.hpp"
#include "core/jet/schemes.hpp"
#include "core/jet/stiffness.hpp"
#include "forces/scene/coulomb_settings.hpp"
#include "forces/scene/distribute.hpp"
#include "forces/scene/initial_jet.hpp"
#include "forces/scene/stress_law.hpp"
#include "forces/terms/air_drag.hpp"
#include "forces/terms/bending.hpp"
#include "forces/terms/constitutive.hpp"
#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/evaporation.hpp"
#include "forces/terms/external_field.hpp"
#include "forces/terms/gravity.hpp"
#include "forces/terms/magnetic_field.hpp"
#include "forces/terms/random_force.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "forces/terms/softened_coulomb.hpp"
#include "forces/terms/surface_energy.hpp"
#include "forces/terms/surface_tension.hpp"
#include "forces/terms/viscoelastic.hpp"
#include "forces/terms/viscous_tension.hpp"

namespace treejet {

namespace {

/// The deck's cutoff is a length of jet as it leaves the nozzle, hence a number of points; without one all
/// pairs count.
int reach(const Parameters& p) {
  constexpr double all = 2e9;
  return static_cast<int>(p.cutoff ? std::min(std::ceil(*p.cutoff / scales(p).l_step), all) : all);
}

template <int D>
class Composer {
 public:
  Composer(const Parameters& p, const Ranks& ranks) : p_(p), g_(groups(p)), ranks_(ranks) {}

  std::unique_ptr<StressLaw<D>> stress_law() {
    using enum StressLawKind;
    const StressLawKind kind = treejet::stress_law(p_);
    const bool rounded = is_jetspin_herschel_bulkley(p_);
    auto law = stress_law_of<D>(p_);
    const char* why = kind != maxwell  ? (p_.kvfluid ? "kvfluid yes" : "stress law")
                      : p_.evaporation ? "evaporation yes"
                      : !rounded       ? "always"
                      : p_.hbfluid     ? "hbfluid yes"
                                       : "yield stress";
    composed.push_back({std::string(law->name()), why});
    if (kind == maxwell && !rounded)
      left_out.push_back({"Herschel-Bulkley stress", "no hbfluid yes, no yield stress"});
    columns = law->columns();
    smooth_stress_ = law->extrapolates();
    return law;
  }

  std::vector<std::unique_ptr<ForceTerm<D>>> local_terms(OwnTerms<D>& own) {
    add(
        true, nullptr, [&] { return std::make_unique<Viscoelastic<D>>(g_.L_step, g_.F_ve); },
        "viscoelastic force");
    const ViscousStress viscous = viscous_stress(p_);
    add(
        viscous.acts(), "no solvent viscosity",
        [&] { return std::make_unique<ViscousTension<D>>(g_.L_step, g_.F_ve, viscous, drying(p_)); },
        "viscous tension");
    add_field();
    add_magnetic_field();
    add(
        g_.F_g != 0, "no gravity yes", [&] { return std::make_unique<Gravity<D>>(g_.F_g); }, "gravity");
    if (p_.surface_model == SurfaceModel::energy) {
      const double alpha = g_.A / (std::numbers::pi * section().radius * section().radius);
      add(
          g_.A != 0, "surface tension is 0",
          [&] { return std::make_unique<SurfaceEnergy<D>>(alpha, section()); }, "surface tension");
    } else if constexpr (D == 3) {
      add(
          g_.A != 0, "surface tension is 0",
          [&] { return std::make_unique<SurfaceTension>(g_.L_step, g_.A); }, "surface tension");
    } else {
      left_out.push_back({"surface tension", "a straight jet (system 1) has no curvature"});
    }
    if constexpr (D == 3)
      add(
          p_.bending, "no bending yes", [&] { return std::make_unique<Bending>(bending()); }, "bending");
    else
      left_out.push_back({"bending", "a straight jet (system 1) has no curvature"});
    add(
        p_.self_field == SelfField::slender && g_.Q != 0,
        g_.Q == 0 ? "density charge is 0" : "self field point",
        [&] { return std::make_unique<SlenderSelfField<D>>(g_.Q, section(), p_.refinement, drying(p_)); },
        "slender self-field");
    add_air();
    add_noise();
    if (softened() && g_.Q != 0) {
      terms_.push_back(std::make_unique<SoftenedCoulomb<D>>(g_.Q, section(), p_.inserting, ranks_));
      composed.push_back({std::string(terms_.back()->name()), "coulomb law softened"});
    }
    for (auto& force : own.forces) {
      composed.push_back({std::string(force->name()), "the caller's own"});
      terms_.push_back(std::move(force));
    }
    for (const auto& term : terms_)
      if (!term->extrapolates()) hasty_ = term->name();
    return std::move(terms_);
  }

  std::vector<std::unique_ptr<ColumnRate<D>>> column_rates(OwnTerms<D>& own) {
    std::vector<std::unique_ptr<ColumnRate<D>>> rates;
    if (p_.evaporation) {
      rates.push_back(std::make_unique<SolventColumn<D>>(Evaporation(p_)));
      columns.push_back(rates.back()->column());
    }
    note(p_.evaporation, "evaporation",
         p_.evaporation_model == EvaporationModel::vapour ? "evaporation model vapour"
                                                          : "evaporation model jetspin",
         "no evaporation yes");
    if constexpr (D == 3)
      for (int k = 0; k < 3 && p_.bending; ++k) {
        rates.push_back(std::make_unique<BendingColumn>(bending(), k));
        columns.push_back(rates.back()->column());
      }
    for (auto& rate : own.columns) {
      columns.push_back(rate->column());
      composed.push_back({"column " + columns.back().name, "the caller's own"});
      rates.push_back(std::move(rate));
    }
    return rates;
  }

  /// Null without charge, where it is softened, or where the subdomains' own solver adds it.
  std::unique_ptr<CoulombForce<D>> coulomb() {
    if (in_subdomains()) {
      note(g_.Q != 0, "Coulomb sum of all subdomains", "parallel distributed", "density charge is 0");
      return nullptr;
    }
    if (g_.Q == 0) {
      left_out.push_back({"Coulomb sum", "density charge is 0"});
      return nullptr;
    }
    if (softened()) return nullptr;
    auto force = std::make_unique<CoulombForce<D>>(g_.Q, field_solver());
    composed.push_back({std::string(force->name()), "named by the deck"});
    return force;
  }

  void boundaries() {
    const char* by = p_.feed == Feed::flow ? "inserting yes, feed flow" : "inserting yes";
    note(p_.inserting, "insertion at the nozzle", by, "no inserting yes");
    note(p_.removing, "removal at the collector", "removing yes", "no removing yes");
    note(p_.perturb, "circling nozzle", "perturb yes", "no perturb yes");
    note(p_.refinement, "splitting and merging of elements", "dynamic refinement yes",
         "no dynamic refinement yes");
  }

  bool in_subdomains() const { return p_.parallel == ParallelData::distributed; }

  /// Multirate needs an error to hold, a sum over all pairs to take apart, and slopes that a parabola can
  /// continue in time.
  bool multirate() {
    const std::string hasty = hasty_.empty() ? "" : hasty_ + " does not let itself be extrapolated";
    const char* why_not =
        !p_.tolerance                            ? "a fixed timestep has no error to hold"
        : p_.multirate == Multirate::no          ? "multirate no"
        : p_.cutoff                              ? "cutoff"
        : properties(chosen_scheme(p_)).implicit ? "a scheme that solves for the local terms"
        : g_.Q == 0                              ? "no Coulomb sum"
        : softened()                             ? "coulomb law softened"
        : p_.evaporation                         ? "masses change with evaporation"
        : !smooth_stress_                        ? "the stress law has a kink or all but a jump"
        : stiffness(p_).relaxes_between_beads()
            ? "stress or drag relaxes, or the magnetic field turns beads, within their interval"
        : !hasty.empty() ? hasty.c_str()
                         : nullptr;
    note(!why_not, "two rates", "multirate auto", why_not);
    return !why_not;
  }

  std::vector<Composed> composed, left_out;
  Columns columns;

 private:
  bool softened() const { return p_.coulomb_law == CoulombLaw::softened; }

  void add_field() {
    const std::array<double, 3> V = field_groups(p_);
    const Waveform wave(p_);
    if (!p_.field_map.empty()) return add_mapped_field(wave);
    add(
        V != std::array<double, 3>{} && !p_.field_needle,
        p_.density_charge == 0 ? "density charge is 0"
        : p_.field_needle      ? "field needle"
                               : "external potential is 0",
        [&] { return std::make_unique<ElectricField<D>>(V, wave); }, "external field");
    if (!p_.field_needle || g_.V == 0) return;
    const NeedleField field(*p_.field_needle / scales(p_).length, g_.H);
    terms_.push_back(std::make_unique<NeedlePlate<D>>(g_.V, field, wave));
    composed.push_back({std::string(terms_.back()->name()), "field needle"});
  }

  void add_mapped_field(const Waveform& wave) {
    if (!p_.map) throw InputError(fmt::format("field map {}: has not been read", p_.field_map));
    if (p_.density_charge == 0) return left_out.push_back({"field of a map", "density charge is 0"});
    const Scales s = scales(p_);
    const double per_field = s.charge / s.mass / (s.length / (s.time * s.time));
    terms_.push_back(std::make_unique<MappedField<D>>(per_field, ScaledMap{p_.map, s.length}, wave));
    composed.push_back({p_.map->name(), "field map"});
  }

  void add_magnetic_field() {
    const std::array<double, 3> M = magnetic_groups(p_);
    const bool acts = M != std::array<double, 3>{};
    if constexpr (D == 3)
      add(
          acts, p_.density_charge == 0 ? "density charge is 0" : "no magnetic field",
          [&] { return std::make_unique<MagneticField>(M); }, "magnetic field");
    else
      left_out.push_back({"magnetic field", "a straight jet (system 1) has no room to turn"});
  }

  void add_air() {
    const char* no_air = "no airdrag yes";
    add(
        in_air(p_), no_air, [&] { return std::make_unique<AirDrag<D>>(air(p_), section(), p_.drag_model); },
        "air drag");
    if constexpr (D == 3)
      add(
          lifts(p_), in_air(p_) ? "airdrag lift no" : no_air,
          [&] { return std::make_unique<AirLift>(air(p_), section(), length_of_lift()); }, "air lift");
    else
      left_out.push_back({"air lift", "a straight jet (system 1) has no curvature"});
  }

  double length_of_lift() const {
    return p_.drag_model == DragModel::jetspin_1_20 ? 1 / scales(p_).length : 0;
  }

  void add_noise() {
    const Noise n = noise(p_);
    const bool white = p_.integrator == Scheme::sra1;
    add(
        n.friction > 0, p_.noise ? "no noise variance" : "no noise yes",
        [&] { return std::make_unique<Friction<D>>(n.friction); }, "friction");
    add(
        is_random(p_) && !white,
        is_random(p_) ? "integrator sra1 has white noise" : "no noise yes, no airdrag amplitude",
        [&] { return std::make_unique<RandomForce<D>>(n); }, "random force");
  }

  /// Maxwell's law has no column, and what dries does not resist.
  BendingMoment bending() const {
    const Scales s = scales(p_);
    return BendingMoment({g_.F_ve, section(), /*first*/ 0, p_.inserting, s.mass * s.velocity * s.velocity});
  }

  Section section() const { return {p_.nozzle_cross / scales(p_).length, g_.L_step}; }

  /// A straight jet has no tree (core/deck/constraints.cpp).
  std::unique_ptr<FieldSolver<D>> field_solver() {
    if constexpr (D == 3)
      if (p_.coulomb != CoulombSum::direct)
        return std::make_unique<CoulombSolver>(coulomb_request(p_, /*points_move*/ true), default_isa(),
                                               TreeRanks{.sharing = ranks_});
    return std::make_unique<DirectSum<D>>(reach(p_), ranks_);
  }

  template <class Make>
  void add(bool wanted, const char* why_not, Make make, const char* name) {
    if (!wanted) return left_out.push_back({name, why_not});
    terms_.push_back(make());
    composed.push_back({std::string(terms_.back()->name()), why_not ? "named by the deck" : "always"});
  }

  void note(bool wanted, const char* name, const char* why, const char* why_not) {
    (wanted ? composed : left_out).push_back({name, wanted ? why : why_not});
  }

  const Parameters& p_;
  Groups g_;
  const Ranks& ranks_;
  std::vector<std::unique_ptr<ForceTerm<D>>> terms_;
  std::string hasty_;  ///< a term whose force multirate may not extrapolate
  bool smooth_stress_ = true;
};

}  // namespace

template <int D>
Scene<D> compose(const Parameters& p, Threads threads, const Ranks& ranks, OwnTerms<D> own) {
  Composer<D> composer(p, ranks);
  auto law = composer.stress_law();
  auto local_terms = composer.local_terms(own);
  auto column_rates = composer.column_rates(own);
  auto coulomb = composer.coulomb();
  composer.boundaries();
  const Columns& columns = composer.columns;
  const Nozzle<D> nozzle(p, columns);
  const std::vector<int> beads = composer.in_subdomains() ? std::vector<int>() : initial_beads(p);
  Scene<D> scene{.jet = initial_jet<D>(p, beads, columns),
                 .nozzle = nozzle,
                 .collector = Collector(p),
                 .columns = columns,
                 .threads = threads};
  scene.motion = std::make_unique<EquationsOfMotion<D>>(nozzle, std::move(law), std::move(local_terms),
                                                        std::move(coulomb), threads);
  for (auto& rate : column_rates) scene.motion->add_column(std::move(rate));
  const bool two_rates = composer.multirate();
  if (two_rates && !composer.in_subdomains())
    scene.multirate = std::make_unique<MultirateMotion<D>>(*scene.motion, ErrorNorm(p, columns),
                                                           ShortWaves(p), p.refinement);
  if constexpr (D == 3)
    if (composer.in_subdomains()) {
      const auto jet_of = [&](const std::vector<int>& rows) { return initial_jet<3>(p, rows, columns); };
      distribute(scene, p, initial_elements(p), jet_of, threads, ranks, two_rates);
    }
  scene.composed = std::move(composer.composed);
  scene.left_out = std::move(composer.left_out);
  return scene;
}

template Scene<1> compose<1>(const Parameters&, Threads, const Ranks&, OwnTerms<1>);
template Scene<3> compose<3>(const Parameters&, Threads, const Ranks&, OwnTerms<3>);

}  // namespace treejet
