#include "core/deck/relations.hpp"

#include <fmt/format.h>

#include "core/jet/noise.hpp"

namespace treejet {

namespace {

constexpr double most_intervals = 1e12;  ///< of the clock of noise, of which each step lies within one

class OfForces : Relations {
 public:
  explicit OfForces(const Relations& all) : Relations(all) {}

  void check() {
    coulomb_sum();
    field();
    drag();
    randomness();
  }

 private:
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
};

}  // namespace

void check_forces(const Relations& all) {
  OfForces(all).check();
}

}  // namespace treejet
