#include "core/deck/constraints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/deck/relations.hpp"
#include "core/deck/subdomains.hpp"
#include "core/jet/noise.hpp"
#include "core/jet/scales.hpp"
#include "core/jet/schemes.hpp"

namespace treejet {

namespace {

class OfRun : Relations {
 public:
  explicit OfRun(const Relations& all) : Relations(all) {}

  void check() {
    time();
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
          {deck(),
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
};

}  // namespace

void check_relations(const Place& deck, const std::vector<Given>& given, const Parameters& parameters,
                     Findings& findings) {
  const Relations all(deck, given, parameters, findings);
  check_jet(all);
  check_forces(all);
  check_fluid(all);
  OfRun(all).check();
}

}  // namespace treejet
