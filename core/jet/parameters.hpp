#pragma once
/// What a deck says, in the deck's units (CGS), before any scaling. One member a directive; the table of
/// core/deck/deck.cpp binds each to its words, unit, meaning and check. An empty optional means "not given".

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace treejet {

enum class Scheme { automatic, euler, heun, rk4, dopri5, verner6, kencarp5 };
enum class EventRule { located, step };
enum class Multirate { automatic, no };
enum class Units { cgs, real };
enum class CoulombSum { direct, tree, automatic };
enum class TreeOrder { automatic, chain, space };
enum class ExpansionKind { local, none };
enum class SelfField { point, slender };
enum class SurfaceModel { paper, energy };
enum class ParallelData { replicated, distributed };

/// How the Coulomb sum is made; what is not given the program chooses.
struct CoulombSetting {
  CoulombSum coulomb = CoulombSum::direct;
  double coulomb_accuracy = 1e-5;  ///< relative L2 error of the field
  std::optional<int> coulomb_order = {}, coulomb_leaf = {};
  std::optional<double> coulomb_opening = {};
  TreeOrder coulomb_tree = TreeOrder::automatic;
  ExpansionKind coulomb_expansions = ExpansionKind::local;
};

struct Parameters : CoulombSetting {
  int system = 3;  ///< 1: straight jet along x; 3: three dimensions
  Units units = Units::cgs;

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
  double nozzle_velocity = 0;     ///< cm/s
  double density_mass = 0;        ///< g/cm^3
  double density_charge = 0;      ///< statC/cm^3
  double viscosity = 0;           ///< g/(cm s)
  double elastic_modulus = 0;     ///< g/(cm s^2)
  double collector_distance = 0;  ///< cm
  double external_potential = 0;  ///< statV
  double surface_tension = 0;     ///< g/s^2
  SurfaceModel surface_model = SurfaceModel::paper;
  SelfField self_field = SelfField::point;
  double yield_stress = 0;  ///< g/(cm s^2)
  bool hbfluid = false;
  double hb_consistency = 1;  ///< in units of the viscosity, strain rates in 1/s
  double hb_index = 1;

  bool gravity = false;
  bool inserting = false;
  bool removing = false;
  std::optional<double> cutoff;  ///< cm

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
