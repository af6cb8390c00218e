#pragma once
/// What a deck says, in the deck's units (CGS), before any scaling. One member a directive; the table of
/// core/deck/deck.cpp binds each to its words, unit, meaning and check. An empty optional means "not given".

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace treejet {

class FieldMap;

enum class Scheme { automatic, euler, heun, rk4, sra1, dopri5, verner6, kencarp5 };
enum class EventRule { located, step };
enum class Multirate { automatic, no };
enum class Units { cgs, real };
enum class CoulombSum { direct, tree, automatic };
enum class TreeOrder { automatic, chain, space };
enum class ExpansionKind { local, none };
enum class CoulombLaw { point, softened };
enum class SelfField { point, slender };
enum class SurfaceModel { paper, energy };
enum class Wave { constant, sine, square, rc, restart, ramp, table, rotating };
enum class DragModel { jetspin, jetspin_1_20, full };
enum class Feed { pull, flow };
enum class Model { paper, slender };
enum class ParallelData { replicated, distributed, automatic };
enum class StressLawKind { maxwell, kelvin_voigt, oldroyd_b, giesekus, fene_p, power_law, herschel_bulkley };
enum class EvaporationModel { vapour, jetspin };
enum class SolventName { water, ethanol, dmf, chloroform, acetone };

/// How the Coulomb sum is made; what is not given the program chooses.
struct CoulombSetting {
  CoulombSum coulomb = CoulombSum::direct;
  double coulomb_accuracy = 1e-5;  ///< relative L2 error of the field
  std::optional<int> coulomb_order = {}, coulomb_leaf = {};
  std::optional<double> coulomb_opening = {};
  TreeOrder coulomb_tree = TreeOrder::automatic;
  ExpansionKind coulomb_expansions = ExpansionKind::local;
};

/// How the external field goes with time and place (core/jet/waveform.hpp, forces/terms/external_field.hpp),
/// and a magnetic one.
struct FieldSetting {
  Wave field_wave = Wave::constant;
  std::optional<double> field_frequency;     ///< Hz
  double field_phase = 0;                    ///< rad
  std::optional<double> field_time;          ///< of capacitor or ramp, s
  std::vector<double> field_table;           ///< t, factor, t, factor, ...; s
  std::vector<double> field_vector;          ///< potentials over collector distance, instead of one along x
  std::optional<double> field_needle;        ///< tip radius, cm
  std::string field_map;                     ///< file; empty: none
  std::shared_ptr<const FieldMap> map = {};  ///< what is in that file, once somebody has read it
  std::vector<double> magnetic_field;        ///< uniform and constant, gauss; empty: none
};

/// The gas around the jet; that of a room at 20 C and 1 atm where the deck names none.
struct AirSetting {
  bool airdrag = false;
  double air_density = 1.21e-3;  ///< g/cm^3
  double air_viscosity = 0.151;  ///< kinematic, cm^2/s
  double air_velocity = 0;       ///< along x, cm/s
  double airdrag_amplitude = 0;  ///< of JETSPIN's random force, see core/jet/noise.hpp
  DragModel drag_model = DragModel::jetspin;
  std::optional<bool> airdrag_lift;  ///< not given: with the models of JETSPIN only
};

/// Random forces (core/jet/noise.hpp).
struct NoiseSetting {
  bool noise = false;
  std::optional<double> noise_diffusivity;  ///< cm^2/s^3
  std::optional<double> noise_variance;     ///< of a component of the velocity, cm^2/s^2
  std::optional<double> noise_interval;     ///< s
  int seed = 1;
};

struct Parameters : CoulombSetting, FieldSetting, AirSetting, NoiseSetting {
  int system = 3;  ///< 1: straight jet along x; 3: three dimensions; 4: the same in air
  Units units = Units::cgs;
  Model model = Model::paper;

  Scheme integrator = Scheme::automatic;
  std::optional<double> timestep;   ///< s
  std::optional<double> tolerance;  ///< scaled local error, see integrators/march/step_control.hpp
  double final_time = 0;            ///< s
  EventRule events = EventRule::located;
  Multirate multirate = Multirate::automatic;

  std::optional<int> points;
  std::optional<double> resolution;  ///< cm
  double initial_length = 0;         ///< cm

  double nozzle_cross = 0;        ///< a_0, radius, cm
  double nozzle_stress = 0;       ///< g/(cm s^2)
  double nozzle_velocity = 0;     ///< cm/s, of feed pull
  double density_mass = 0;        ///< g/cm^3
  double density_charge = 0;      ///< statC/cm^3
  double viscosity = 0;           ///< g/(cm s)
  double elastic_modulus = 0;     ///< g/(cm s^2)
  double collector_distance = 0;  ///< cm
  double external_potential = 0;  ///< statV
  double surface_tension = 0;     ///< g/s^2
  SurfaceModel surface_model = SurfaceModel::paper;
  bool bending = false;
  SelfField self_field = SelfField::point;

  StressLawKind stress_law = StressLawKind::maxwell;
  bool kvfluid = false;     ///< JETSPIN's words for Kelvin and Voigt's
  double yield_stress = 0;  ///< g/(cm s^2)
  bool hbfluid = false;
  double hb_consistency = 1;  ///< in units of the viscosity, strain rates in 1/s
  double hb_index = 1;
  std::optional<double> small_strain_rate;  ///< 1/s
  std::optional<double> mobility;           ///< of Giesekus' law
  std::optional<double> extensibility;      ///< L of FENE-P
  double solvent_viscosity = 0;             ///< g/(cm s)

  bool evaporation = false;
  EvaporationModel evaporation_model = EvaporationModel::jetspin;
  SolventName solvent = SolventName::water;
  double polymer_fraction = 0.06;            ///< of the fluid as it leaves the nozzle
  double temperature = 293.15;               ///< K
  double humidity = 0;                       ///< relative
  std::optional<double> vapour_density;      ///< saturated, g/cm^3
  std::optional<double> vapour_diffusivity;  ///< cm^2/s
  double drying_air_viscosity = 0.151;       ///< kinematic, cm^2/s
  double flory_chi = 0.5;
  double viscosity_b = 7, viscosity_m = 0.1;  ///< mu = mu_0 10^(B (c^m - c_0^m))
  double relaxation_t = 1;                    ///< theta = theta_0 (c/c_0)^t

  bool gravity = false;
  bool inserting = false;
  bool dragvel = true;  ///< beads are released with the paper's dragging velocity
  Feed feed = Feed::pull;
  std::optional<double> flow_rate;  ///< cm^3/s, of feed flow
  bool removing = false;
  std::optional<double> cutoff;  ///< cm
  CoulombLaw coulomb_law = CoulombLaw::point;

  bool perturb = false;
  double perturb_frequency = 0;  ///< angular, rad/s
  double perturb_amplitude = 0;  ///< cm

  bool refinement = false;
  std::optional<double> refinement_tolerance;  ///< of an arc drawn by a chord, core/jet/spacing.hpp
  std::optional<double> refinement_threshold;  ///< longest element, cm
  std::optional<double> refinement_every;      ///< s
  double refinement_start = 0;                 ///< s

  std::optional<double> print_time;  ///< s
  std::vector<std::string> print_list;
  std::vector<std::string> printstat_list;
  std::optional<double> print_xyz;  ///< s
  int xyz_maxnum = 100;
  double xyz_rescale = 1;
  std::optional<double> print_hdf5;  ///< s

  ParallelData parallel = ParallelData::replicated;

  std::optional<double> checkpoint;  ///< s of wall-clock time
};

/// `system 4` is `system 3` with `airdrag yes`.
inline bool in_air(const Parameters& p) {
  return p.airdrag || p.system == 4;
}
inline bool lifts(const Parameters& p) {
  return in_air(p) && p.airdrag_lift.value_or(p.drag_model != DragModel::full);
}

/// A random path is not cut within a step: its scheme meets events at step ends.
inline EventRule event_rule(const Parameters& p) {
  return p.integrator == Scheme::sra1 ? EventRule::step : p.events;
}

inline StressLawKind stress_law(const Parameters& p) {
  return p.kvfluid ? StressLawKind::kelvin_voigt : p.stress_law;
}

/// The interval of the tables in s; without print time JETSPIN's 1000 steps, or a hundredth of the run.
inline double print_interval(const Parameters& p) {
  if (p.print_time) return *p.print_time;
  return p.timestep ? 1000 * *p.timestep : p.final_time / 100;
}

/// Signals and the clock are looked at between steps: samples within one must not take long.
inline constexpr double most_samples_of_a_step = 1e5;

/// The shortest interval of any output, s.
inline double shortest_interval(const Parameters& p) {
  double shortest = p.final_time;
  if (!p.print_list.empty() || !p.printstat_list.empty()) shortest = std::min(shortest, print_interval(p));
  for (const auto& interval : {p.print_xyz, p.print_hdf5})
    if (interval) shortest = std::min(shortest, *interval);
  return shortest;
}

}  // namespace treejet
