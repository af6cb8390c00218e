#include "core/deck/constraints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>

#include "core/deck/observable_keys.hpp"
#include "core/deck/subdomains.hpp"
#include "core/jet/noise.hpp"
#include "core/jet/scales.hpp"
#include "core/jet/schemes.hpp"
#include "core/jet/stiffness.hpp"

namespace treejet {

namespace {

constexpr double round_off = 1e-9;  ///< relative: a third of 0.02 typed with ten digits is a third
constexpr double most_elements = 1e8;
constexpr double most_intervals = 1e12;  ///< of the clock of noise, of which each step lies within one

class Relations {
 public:
  Relations(const Place& deck, const std::vector<Given>& given, const Parameters& p, Findings& findings)
      : deck_(deck), given_(given), p_(p), findings_(findings) {}

  void check() {
    time();
    initial_jet();
    perturbation();
    coulomb_sum();
    self_field();
    bending();
    refinement();
    feed();
    fluid();
    field();
    drag();
    randomness();
    evaporation();
    output();
    subdomains();
    if (!composable()) return;
    finite_scales();
    magnetic_turns();
  }

 private:
  void time() {
    const bool adaptive = properties(p_.integrator).adaptive;
    const double timestep = p_.timestep.value_or(0);
    error(is_given("timestep") && !is_given("tolerance") && adaptive, {"integrator", "timestep"},
          fmt::format("timestep needs integrator {}; {} choose the step themselves and go with tolerance",
                      scheme_words(false, "or", /*numbers*/ true), scheme_words(true, "and")));
    error(is_given("tolerance") && !is_given("timestep") && !adaptive, {"integrator", "tolerance"},
          fmt::format("tolerance needs integrator {}; {} go with timestep", scheme_words(true, "or"),
                      scheme_words(false, "and")));
    error(timestep >= p_.final_time, {"timestep", "final time"},
          fmt::format("expected less than final time ({} s)", p_.final_time));
  }

  void initial_jet() {
    const double length = p_.initial_length, radius = p_.nozzle_cross;
    if (length > p_.collector_distance)
      return error(true, {"initial length", "collector distance"},
                   fmt::format("expected at most collector distance ({} cm)", p_.collector_distance));
    if (p_.resolution && !divides(*p_.resolution)) return;
    const std::optional<double> element = element_length();
    if (!element) return;
    const std::string_view division = is_given("points") ? "points" : "resolution";
    const double l_step = *element;
    note(l_step < radius * (1 - round_off), division,
         fmt::format(
             "elements ({:.6g} cm) are shorter than nozzle cross ({} cm); the model takes them for slender, "
             "and JETSPIN refuses them",
             l_step, radius));
    const double first_distance = std::hypot(1.0, p_.perturb_amplitude / l_step);
    note(p_.inserting && p_.perturb && first_distance >= 2, "perturb ampl",
         fmt::format("the nozzle begins {:.3g} elements from the bead next to it, and lets one go at once",
                     first_distance));
    error(p_.inserting && p_.collector_distance <= 2 * l_step,
          {"inserting", "collector distance", "initial length", division},
          fmt::format(
              "expected a collector distance above two elements ({:.6g} cm): a bead is released when its "
              "predecessor is that far away",
              2 * l_step));
  }

  bool divides(double resolution) {
    const double elements = p_.initial_length / resolution, fewer = std::floor(elements);
    if (elements > most_elements) {
      error(true, {"resolution", "initial length"},
            fmt::format("expected at most {:.0e} elements", most_elements));
      return false;
    }
    if (std::abs(elements - std::round(elements)) <= round_off * elements) return true;
    const std::string longer = fewer > 0 ? fmt::format("{:.10g} or ", p_.initial_length / fewer) : "";
    error(true, {"resolution", "initial length"},
          fmt::format("expected a divisor of initial length ({} cm); did you mean {}{:.10g}?",
                      p_.initial_length, longer, p_.initial_length / (fewer + 1)));
    return false;
  }

  void coulomb_sum() {
    const bool tree = p_.coulomb != CoulombSum::direct;
    error(tree && p_.system == 1, {"coulomb", "system"},
          "expected coulomb direct in system 1, which has no tree");
    error(tree && p_.cutoff.has_value(), {"coulomb", "cutoff"},
          "expected no cutoff: the tree sums over all pairs");
    only_with(tree, "coulomb tree or coulomb auto",
              {"coulomb accuracy", "coulomb order", "coulomb opening", "coulomb leaf", "coulomb tree",
               "coulomb expansions"});
    if (p_.coulomb_law == CoulombLaw::softened) softened_law();
  }

  void softened_law() {
    const bool tree = p_.coulomb != CoulombSum::direct;
    error(tree, {"coulomb law", "coulomb"},
          "expected coulomb direct, or coulomb law point, which trees have");
    error(p_.cutoff.has_value(), {"coulomb law", "cutoff"}, "expected no cutoff, or coulomb law point");
    error(p_.self_field == SelfField::slender,
          {p_.model == Model::slender ? "model" : "self field", "coulomb law"},
          "expected coulomb law point: the self-field of a tube completes that law");
    error(p_.feed == Feed::flow && p_.self_field == SelfField::point, {"coulomb law", "feed"},
          "expected feed pull, or coulomb law point");
    note(p_.density_charge == 0, "coulomb law", "no effect: density charge is 0");
  }

  void self_field() {
    if (p_.self_field == SelfField::point) return;
    error(p_.cutoff.has_value(), {p_.model == Model::slender ? "model" : "self field", "cutoff"},
          "expected no cutoff: the field of a tube on itself is completed by that of all its charges");
    note(p_.density_charge == 0, "self field", "no effect: density charge is 0");
    note(p_.inserting && p_.feed == Feed::pull, "self field",
         "the paper's rule of insertion lets its rate follow from the push of the nozzle's charge on the "
         "first bead: with slender it depends on the length of the elements more, not less; feed flow does "
         "not let it");
    const std::optional<double> l_step = element_length();
    note(l_step && *l_step < 2 * p_.nozzle_cross * (1 - round_off), "self field",
         fmt::format(
             "elements ({:.6g} cm) are shorter than twice nozzle cross ({} cm): too short for a slender "
             "tube, its self-field is limited",
             l_step.value_or(0), p_.nozzle_cross));
  }

  /// A feature that knows these laws alone, and nothing that adds to them.
  void law_without_extras(const char* feature, bool known, std::string_view laws, std::string_view why) {
    error(!known || p_.hbfluid || p_.yield_stress > 0 || p_.solvent_viscosity > 0,
          {feature, "stress law", "kvfluid", "hbfluid", "yield stress", "solvent viscosity"},
          fmt::format("expected {} without yield stress, hbfluid or solvent viscosity: {}", laws, why));
  }

  void bending() {
    if (!p_.bending) return;
    error(p_.system == 1, {"bending", "system"}, "expected system 3: a straight jet does not bend");
    law_without_extras("bending", stress_law(p_) == StressLawKind::maxwell, "stress law maxwell",
                       "only of a linear law is the moment known from the strain rate of the axis");
    error(p_.evaporation, {"bending", "evaporation"},
          "expected no evaporation: the section would dry unevenly");
    error(p_.refinement, {"bending", "dynamic refinement"},
          "expected no dynamic refinement: moments are not split nor merged; shorter elements do instead");
    error(composable() && properties(chosen_scheme(p_)).implicit, {"bending", "integrator"},
          fmt::format("expected integrator verner6 or dopri5: kencarp5{} does not solve for moments",
                      p_.integrator == Scheme::automatic ? ", which auto takes for this scene," : ""));
  }

  void refinement() {
    only_with(p_.refinement, "dynamic refinement yes",
              {"dynamic refinement tolerance", "dynamic refinement threshold", "dynamic refinement every",
               "dynamic refinement start"});
    if (!p_.refinement) return;
    error(!is_given("dynamic refinement tolerance") && !is_given("dynamic refinement threshold"),
          {"dynamic refinement"},
          "expected dynamic refinement tolerance or dynamic refinement threshold to be given, too");
    error(!p_.inserting && !is_given("dynamic refinement every"), {"dynamic refinement", "inserting"},
          "expected dynamic refinement every to be given, too: without inserting yes no release tells when "
          "to look");
    error(p_.cutoff.has_value(), {"dynamic refinement", "cutoff"},
          "expected no cutoff: its reach is a number of beads");
    note(p_.self_field == SelfField::point && p_.density_charge != 0, "dynamic refinement",
         "halving the elements of a chain of point charges changes the force on it; write self field "
         "slender for one that does not depend on them");
    const std::optional<double> l_step = element_length();
    if (!p_.refinement_threshold || !l_step) return;
    const double least = 2 * std::max(*l_step, p_.nozzle_cross);
    error(*p_.refinement_threshold < least * (1 - round_off),
          {"dynamic refinement threshold", "nozzle cross"},
          fmt::format("expected at least {:.6g} cm, twice the length ({:.6g} cm) of an element as the nozzle "
                      "lets it go and twice nozzle cross ({} cm)",
                      least, *l_step, p_.nozzle_cross));
  }

  void feed() {
    const bool flow = p_.feed == Feed::flow, by_model = p_.model == Model::slender;
    const char* says_so = by_model ? "model" : "feed";
    error(flow && !p_.inserting, {says_so, "inserting"},
          by_model
              ? "expected inserting yes; a jet without it is self field slender, surface tension model energy"
              : "expected inserting yes: without it nothing flows");
    error(flow && !is_given("flow rate"), {says_so}, "expected flow rate to be given, too, as 2 mL/h");
    error(!flow && is_given("flow rate"), {"flow rate", "feed"},
          "expected feed flow to be given, too: by feed pull the jet draws what it pulls");
    note(is_given("dragvel") && (flow || !p_.inserting), "dragvel",
         flow ? "no effect: by feed flow a bead is released with the velocity of its fluid"
              : "no effect without inserting yes");
    error(flow && is_given("nozzle velocity"), {"nozzle velocity", "feed", "flow rate"},
          p_.nozzle_cross > 0
              ? fmt::format("expected none: it is {:.6g} cm/s, from flow rate and nozzle cross",
                            inlet_velocity(p_))
              : "expected none: it follows from flow rate and nozzle cross");
  }

  void perturbation() {
    error(p_.perturb && p_.system == 1, {"perturb", "system"},
          "expected no in system 1: a straight jet does not circle");
    error(p_.perturb && !is_given("perturb freq"), {"perturb"}, "expected perturb freq to be given, too");
    error(p_.perturb && !is_given("perturb ampl"), {"perturb"}, "expected perturb ampl to be given, too");
    error(p_.perturb && p_.perturb_amplitude > p_.initial_length, {"perturb ampl", "initial length"},
          fmt::format("expected at most initial length ({} cm)", p_.initial_length));
    only_with(p_.perturb, "perturb yes", {"perturb freq", "perturb ampl"});
    const bool of_paper = p_.surface_model == SurfaceModel::paper;
    note(p_.system == 1 && p_.surface_tension > 0 && of_paper, "surface tension",
         "no effect in system 1 without surface tension model energy");
    note(!of_paper && p_.surface_tension == 0, "surface tension model", "no effect: surface tension is 0");
  }

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

  void field() {
    const Wave wave = p_.field_wave;
    const bool periodic = wave == Wave::sine || wave == Wave::square || wave == Wave::rc ||
                          wave == Wave::restart || wave == Wave::rotating;
    const bool capacitor = wave == Wave::rc || wave == Wave::restart, vector = is_given("field vector");
    needs(periodic, "field frequency");
    needs(capacitor || wave == Wave::ramp, "field time");
    needs(wave == Wave::table, "field table");
    needs(wave == Wave::rotating, "field vector");
    note(!periodic && p_.field_phase != 0, "field phase", "no effect without a periodic field wave");
    error(vector && p_.field_vector.size() != 3, {"field vector"}, "expected three numbers, for x, y and z");
    error(vector && is_given("external potential"), {"field vector", "external potential"},
          "expected no external potential besides, which is its first number");
    error(vector && p_.system == 1, {"field vector", "system"}, "expected external potential in system 1");
    error(vector && p_.field_needle, {"field needle", "field vector"},
          "expected external potential: the field of a needle has its own direction");
    const bool mapped = !p_.field_map.empty();
    error(mapped && is_given("external potential"), {"external potential", "field map"},
          "expected none: the map has potentials of its own");
    error(mapped && vector, {"field vector", "field map"},
          "expected none: the map has a direction of its own");
    error(mapped && p_.field_needle, {"field needle", "field map"}, "expected one of the two");
    bool ordered = p_.field_table.size() % 2 == 0;
    for (std::size_t k = 2; k + 1 < p_.field_table.size(); k += 2)
      ordered &= p_.field_table[k] > p_.field_table[k - 2];
    error(!ordered, {"field table"}, "expected pairs of a time, later each time, and a factor");
    magnetic_field();
    const double pull =
        (p_.field_vector.empty() ? p_.external_potential : p_.field_vector[0]) * p_.density_charge;
    note(pull < 0, vector ? "field vector" : "external potential",
         "with this sign of density charge the field drives beads back to the nozzle");
    constexpr double most_halves = 1e9;
    const double halves = 2 * p_.field_frequency.value_or(0) * p_.final_time;
    error(halves > most_halves, {"field frequency", "final time"},
          fmt::format("expected at most {:.3g} Hz: at most {:.0e} half periods in final time ({} s)",
                      most_halves / (2 * p_.final_time), most_halves, p_.final_time));
  }

  void magnetic_field() {
    const bool magnetic = is_given("magnetic field");
    error(magnetic && p_.magnetic_field.size() != 3, {"magnetic field"},
          "expected three numbers, for x, y and z");
    error(magnetic && p_.system == 1, {"magnetic field", "system"},
          "expected system 3: a straight jet has no room to turn");
    note(magnetic && p_.density_charge == 0, "magnetic field", "no effect without density charge");
  }

  /// A detail that this field wave is made of, and others are not.
  void needs(bool needed, const char* detail) {
    error(needed && !is_given(detail), {"field wave"}, fmt::format("expected {} to be given, too", detail));
    if (std::string_view(detail) != "field vector")
      note(!needed && is_given(detail), detail, "no effect with this field wave");
  }

  void drag() {
    error(p_.system == 4 && is_given("airdrag") && !p_.airdrag, {"system", "airdrag"},
          "expected airdrag yes, which system 4 means, or system 3");
    only_with(in_air(p_), "airdrag yes",
              {"airdrag airdensity", "airdrag airviscosity", "airdrag airvelocity", "airdrag model",
               "airdrag lift", "airdrag amplitude"});
    const bool full = in_air(p_) && p_.drag_model == DragModel::full;
    note(full && p_.system == 1, "airdrag model", "in system 1 there is drag along the jet only");
    note(
        full && p_.system != 1 && p_.removing, "airdrag model",
        "coils that sink slower than the jet feeds them pile up; that they touch each other is not modelled");
    error(p_.system == 1 && p_.airdrag_lift.value_or(false), {"airdrag lift", "system"},
          "expected no in system 1: a straight jet has no bends");
  }

  void randomness() {
    error(p_.noise && !is_given("noise diffusivity"), {"noise"},
          "expected noise diffusivity to be given, too");
    only_with(p_.noise, "noise yes", {"noise diffusivity", "noise variance"});
    const bool white = p_.integrator == Scheme::sra1;
    note(is_given("noise interval") && (white || !is_random(p_)), "noise interval",
         white ? "no effect: the noise of integrator sra1 is white" : "no effect: nothing here is random");
    note(is_given("seed") && !is_random(p_), "seed", "no effect: nothing here is random");
    if (p_.noise_interval && sound("noise interval"))
      error(p_.final_time / *p_.noise_interval > most_intervals, {"noise interval", "final time"},
            fmt::format("expected at least {:.3g} s: at most {:.0e} intervals of final time ({} s)",
                        p_.final_time / most_intervals, most_intervals, p_.final_time));
    note(white && is_given("events") && p_.events == EventRule::located, "events",
         "no effect with integrator sra1: a random path is not cut within a step");
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
    error(p_.self_field == SelfField::slender && p_.refinement, {"evaporation", "dynamic refinement"},
          "expected no dynamic refinement with self field slender: joints between elements go by their "
          "charge, which no longer follows from their volume");
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

  void output() {
    only_with(p_.print_xyz.has_value(), "print xyz and an interval",
              {"print xyz maxnum", "print xyz rescale"});
    interval("print time", p_.print_time);
    interval("print xyz", p_.print_xyz);
    interval("print hdf5", p_.print_hdf5);
  }

  /// Samples far closer than steps would fill any disk, and no signal is seen within a step.
  void interval(std::string_view words, const std::optional<double>& seconds) {
    constexpr double most_samples = 1e9;
    const double timestep = p_.timestep.value_or(0);
    if (!seconds) return;
    note(*seconds > p_.final_time && sound("final time"), words,
         fmt::format("longer than final time ({} s): nothing is written between start and end",
                     p_.final_time));
    error(p_.final_time / *seconds > most_samples, {words, "final time"},
          fmt::format("expected at least {:.3g} s: at most {:.0e} samples of final time ({} s)",
                      p_.final_time / most_samples, most_samples, p_.final_time));
    error(timestep / *seconds > most_samples_of_a_step && p_.final_time / *seconds <= most_samples,
          {words, "timestep"},
          fmt::format("expected at least {:.3g} s: at most {:.0e} samples of a step ({} s)",
                      timestep / most_samples_of_a_step, most_samples_of_a_step, timestep));
  }

  /// Everything that scales and groups are made of is given and sound.
  bool composable() const {
    const std::span<const Directive> all = directives();
    return is_given("points") != is_given("resolution") &&
           std::all_of(all.begin(), all.end(), [&](const Directive& d) { return sound(d.words); });
  }

  /// Each parameter is a number, but their products may be none: they overflow, or what is not zero becomes
  /// it.
  void finite_scales() {
    const Scales s = scales(p_);
    const Groups g = groups(p_);
    const bool charged = p_.density_charge != 0;
    struct Product {
      const char* name;
      double value;
      bool positive;
    };
    const Product products[] = {{"length", s.length, true},
                                {"time", s.time, true},
                                {"velocity", s.velocity, true},
                                {"mass", s.mass, true},
                                {"charge", s.charge, charged},
                                {"Q (Coulomb)", g.Q, charged},
                                {"V (external field)", g.V, charged && p_.external_potential != 0},
                                {"F_ve (viscoelastic)", g.F_ve, true},
                                {"A (surface tension)", g.A, p_.surface_tension > 0},
                                {"F_g (gravity)", g.F_g, p_.gravity},
                                {"K_s (nozzle)", g.K_s, p_.perturb && p_.perturb_frequency > 0},
                                {"H (collector)", g.H, true},
                                {"L_step (element)", g.L_step, true},
                                {"air density", air(p_).density, in_air(p_)},
                                {"air viscosity", air(p_).viscosity, in_air(p_)},
                                {"turn in the magnetic field", turn_rate(p_), turn_rate(p_) != 0},
                                {"noise", noise(p_).squared_amplitude(1), is_random(p_)}};
    for (const Product& product : products) {
      if (std::isfinite(product.value) && (!product.positive || std::isnormal(product.value))) continue;
      findings_.errors.push_back(
          {deck_,
           fmt::format("the scale or group {} is {}: the parameters are too far apart for double precision",
                       product.name, product.value)});
      return;
    }
  }

  /// Each turn takes a few steps.
  void magnetic_turns() {
    constexpr double most_turns = 1e9;
    const double angle = turn_rate(p_) * p_.final_time;
    error(angle > 2 * std::numbers::pi * most_turns, {"magnetic field", "final time"},
          fmt::format("beads would go round {:.0e} times in final time ({} s), which no run can follow",
                      angle / (2 * std::numbers::pi), p_.final_time));
  }

  void subdomains() {
    if (p_.parallel != ParallelData::distributed) return;
    for (const Obstacle& o : obstacles_to_subdomains(p_)) error(true, o.directives, o.message);
  }

  const Given* find(std::string_view words) const { return treejet::find(given_, directive(words)); }

  bool is_given(std::string_view words) const { return find(words) != nullptr; }

  /// Of the initial jet, cm; none if its lines are faulty, or divide it twice or not at all.
  std::optional<double> element_length() const {
    if (is_given("points") == is_given("resolution") || !sound("initial length")) return std::nullopt;
    if (is_given("resolution")) return sound("resolution") ? p_.resolution : std::nullopt;
    if (!sound("points")) return std::nullopt;
    return p_.initial_length / p_.points.value_or(1);
  }

  /// Details of what a deck may leave off.
  void only_with(bool on, const char* that, std::initializer_list<const char*> details) {
    for (const char* detail : details)
      note(!on && is_given(detail), detail, fmt::format("no effect without {}", that));
  }

  bool sound(std::string_view words) const {
    const Given* g = find(words);
    return g ? !g->faulty : !directive(words).mandatory;
  }

  Finding about(std::string_view words, const std::string& message) const {
    const Given* g = find(words);
    if (!g) return {deck_, fmt::format("{}: {}", words, message)};
    return {g->place, fmt::format("{} {}: {}", words, fmt::join(g->arguments, " "), message)};
  }

  /// Blames the first of the directives concerned.
  void error(bool violated, const std::vector<std::string_view>& directives, const std::string& message) {
    if (violated &&
        std::all_of(directives.begin(), directives.end(), [&](auto words) { return sound(words); }))
      findings_.errors.push_back(about(directives.front(), message));
  }

  void note(bool holds, std::string_view words, const std::string& message) {
    if (holds && sound(words)) findings_.notes.push_back(about(words, message));
  }

  const Place& deck_;
  const std::vector<Given>& given_;
  const Parameters& p_;
  Findings& findings_;
};

}  // namespace

void check_relations(const Place& deck, const std::vector<Given>& given, const Parameters& parameters,
                     Findings& findings) {
  Relations(deck, given, parameters, findings).check();
}

}  // namespace treejet
