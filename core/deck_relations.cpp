#include "core/deck_relations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace treejet {

namespace {

constexpr double divides = 1e-9;  ///< relative; a decimal such as 0.1 / 0.02 is off by 1e-16
constexpr double most_elements = 1e8;

class Relations {
 public:
  Relations(const std::string& deck_name, const std::vector<Given>& given, const Parameters& p,
            Findings& findings)
      : deck_name_(deck_name), given_(given), p_(p), findings_(findings) {}

  void check() {
    time();
    initial_jet();
    nozzle_and_collector();
    fluid();
    output();
  }

 private:
  void time() {
    const bool adaptive = p_.integrator == Scheme::automatic || p_.integrator == Scheme::dopri5 ||
                          p_.integrator == Scheme::verner6;
    const double timestep = p_.timestep.value_or(0);
    error(
        is_given("timestep") && adaptive, {"integrator", "timestep"},
        "timestep needs integrator 1 (euler), 2 (heun) or 3 (rk4); auto, dopri5 and verner6 choose the step "
        "themselves and go with tolerance");
    error(is_given("tolerance") && !adaptive, {"integrator", "tolerance"},
          "tolerance needs integrator auto, dopri5 or verner6; euler, heun and rk4 go with timestep");
    error(timestep >= p_.final_time, {"timestep", "final time"},
          fmt::format("expected less than final time ({} s)", p_.final_time));
    error(p_.print_time.value_or(0) > p_.final_time, {"print time", "final time"},
          fmt::format("expected at most final time ({} s)", p_.final_time));
  }

  void initial_jet() {
    const double length = p_.initial_length, radius = p_.nozzle_cross;
    if (length < radius)
      return error(true, {"initial length", "nozzle cross"},
                   fmt::format("expected at least nozzle cross ({} cm)", radius));
    error(length >= p_.collector_distance, {"initial length", "collector distance"},
          fmt::format("expected less than collector distance ({} cm)", p_.collector_distance));
    if (p_.resolution) resolution_divides(length, *p_.resolution);
    error(l_step() < radius, {p_.points ? "points" : "resolution", "initial length", "nozzle cross"},
          fmt::format("expected elements (here {:.6g} cm) at least as long as nozzle cross ({} cm)", l_step(),
                      radius));
  }

  void resolution_divides(double length, double resolution) {
    const double elements = length / resolution;
    if (elements > most_elements)
      return error(true, {"resolution", "initial length"},
                   fmt::format("expected at most {:.0e} elements", most_elements));
    if (std::abs(elements - std::round(elements)) <= divides * elements) return;
    const double fewer = std::floor(elements);
    std::string nearest = fmt::format("{:.10g}", length / (fewer + 1));
    if (fewer > 0) nearest = fmt::format("{:.10g} or ", length / fewer) + nearest;
    error(true, {"resolution", "initial length"},
          fmt::format("expected a divisor of initial length ({} cm); did you mean {}?", length, nearest));
  }

  void nozzle_and_collector() {
    error(p_.inserting && p_.collector_distance <= 2 * l_step(),
          {"inserting", "collector distance", "initial length"},
          fmt::format(
              "expected a collector distance above two elements ({:.6g} cm): a bead is released when its "
              "predecessor is that far away",
              2 * l_step()));
    error(p_.perturb && p_.system == 1, {"perturb", "system"},
          "expected no in system 1: a straight jet does not circle");
    error(p_.perturb && !is_given("perturb freq"), {"perturb"}, "expected perturb freq to be given, too");
    error(p_.perturb && !is_given("perturb ampl"), {"perturb"}, "expected perturb ampl to be given, too");
    error(p_.perturb && p_.perturb_amplitude >= p_.initial_length, {"perturb ampl", "initial length"},
          fmt::format("expected less than initial length ({} cm)", p_.initial_length));
    for (const char* detail : {"perturb freq", "perturb ampl"})
      note(!p_.perturb && is_given(detail), detail, "no effect without perturb yes");
    note(p_.system == 1 && p_.surface_tension > 0, "surface tension", "no effect in system 1");
  }

  void fluid() {
    for (const char* detail : {"hbfluid consistency", "hbfluid index"}) {
      error(p_.hbfluid && !is_given(detail), {"hbfluid"},
            fmt::format("expected {} to be given, too", detail));
      error(!p_.hbfluid && is_given(detail), {detail, "hbfluid"}, "expected hbfluid yes to be given, too");
    }
  }

  void output() {
    for (const char* detail : {"print xyz maxnum", "print xyz rescale"})
      note(!p_.print_xyz && is_given(detail), detail, "no effect without print xyz and an interval");
    note(is_given("seed"), "seed", "no effect: nothing here is random");
  }

  double l_step() const { return p_.points ? p_.initial_length / *p_.points : p_.resolution.value_or(0); }

  const Given* find(std::string_view words) const {
    const auto found = std::find_if(given_.begin(), given_.end(),
                                    [d = &directive(words)](const Given& g) { return g.directive == d; });
    return found == given_.end() ? nullptr : &*found;
  }

  bool is_given(std::string_view words) const { return find(words) != nullptr; }

  bool sound(std::string_view words) const {
    const Given* g = find(words);
    return g ? g->valid : !directive(words).mandatory;
  }

  std::string at(std::string_view words) const {
    const Given* g = find(words);
    return g ? fmt::format("{}: {} {}: ", g->where, words, fmt::join(g->arguments, " "))
             : fmt::format("{}: {}: ", deck_name_, words);
  }

  /// Blames the first of the directives concerned.
  void error(bool violated, std::initializer_list<std::string_view> directives, const std::string& message) {
    if (violated &&
        std::all_of(directives.begin(), directives.end(), [&](auto words) { return sound(words); }))
      findings_.errors.push_back(at(*directives.begin()) + message);
  }

  void note(bool holds, std::string_view words, const std::string& message) {
    if (holds && sound(words)) findings_.notes.push_back(at(words) + message);
  }

  const std::string& deck_name_;
  const std::vector<Given>& given_;
  const Parameters& p_;
  Findings& findings_;
};

}  // namespace

void check_relations(const std::string& deck_name, const std::vector<Given>& given,
                     const Parameters& parameters, Findings& findings) {
  Relations(deck_name, given, parameters, findings).check();
}

}  // namespace treejet
