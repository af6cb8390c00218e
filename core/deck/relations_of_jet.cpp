#include "core/deck/relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/jet/noise.hpp"
#include "core/jet/scales.hpp"
#include "core/jet/schemes.hpp"
#include "core/jet/stiffness.hpp"

namespace treejet {

namespace {

constexpr double most_elements = 1e8;

class OfJet : Relations {
 public:
  explicit OfJet(const Relations& all) : Relations(all) {}

  void check() {
    initial_jet();
    perturbation();
    self_field();
    bending();
    refinement();
    feed();
  }

 private:
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

  void bending() {
    if (!p_.bending) return;
    error(p_.system == 1, {"bending", "system"}, "expected system 3: a straight jet does not bend");
    law_without_extras("bending", stress_law(p_) == StressLawKind::maxwell, "stress law maxwell",
                       "only of a linear law is the moment known from the strain rate of the axis");
    error(p_.evaporation, {"bending", "evaporation"},
          "expected no evaporation: the section would dry unevenly");
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
    note(p_.noise && p_.noise_diffusivity.value_or(0) > 0, "dynamic refinement",
         "noise shakes each bead by itself, so that the fluid of a split element is shaken less; that of "
         "airdrag amplitude goes by mass and does not depend on the elements");
    note(is_random(p_) && p_.refinement_tolerance, "dynamic refinement tolerance",
         "noise bends a jet from bead to bead, however short its elements are: they are split down to "
         "twice their radius; dynamic refinement threshold goes by their length alone");
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
};

}  // namespace

void check_jet(const Relations& all) {
  OfJet(all).check();
}

}  // namespace treejet
