#include "integrators/run/check_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/deck/deck.hpp"
#include "core/deck/lab_sheet.hpp"
#include "core/io/field_map_file.hpp"
#include "core/io/run_record.hpp"
#include "core/jet/scales.hpp"
#include "forces/scene/scene_description.hpp"
#include "integrators/run/trial_run.hpp"

namespace treejet {

namespace {

/// What the second half of a trial, which the start disturbs less, tells of the flow.
Draw draw(const Parameters& p, const Trial& trial) {
  const Scales s = scales(p);
  const TrialSample& last = trial.samples.back();
  const auto middle = std::find_if(trial.samples.begin(), trial.samples.end(),
                                   [&](const TrialSample& sample) { return 2 * sample.t >= last.t; });
  const double seconds = (last.t - middle->t) * s.time, bead_volume = s.mass / p.density_mass;
  const auto beads = static_cast<double>(last.inserted - middle->inserted);
  return {seconds > 0 ? beads * bead_volume / seconds : 0, last.v * s.velocity};
}

/// The plan in the rows of a sheet.
std::vector<SheetRow> plan_rows(const Plan& e) {
  std::vector<SheetRow> rows = {{"most_beads", "beads at most", e.most_beads, ""},
                                {"mean_beads", "beads in the mean", e.mean_beads, ""},
                                {"inserted", "beads inserted", e.inserted, ""},
                                {"evaluations", "evaluations of the forces", e.evaluations, ""},
                                {"steps", "steps", e.steps, ""},
                                {"wall_time", "time on this machine", e.seconds, "s"},
                                {"memory", "memory", e.memory, "B"}};
  if (e.first_arrival) rows.push_back({"first_arrival", "first arrival", *e.first_arrival, "s"});
  return rows;
}

template <int D>
void check(const Deck& deck, bool json, const OwnPhysics& own) {
  const Parameters& p = deck.parameters;
  expect_feasible_trial(p);
  Scene<D> scene = compose<D>(p, {available_cores()}, {}, own_terms<D>(own, p));
  if (!json) {
    fmt::print("{}: a complete deck\n{}{}{}", deck.name, notes(deck), scales_description(p),
               composition(scene.composed, scene.left_out));
    fmt::print("{}, {}\n", name(chosen_scheme(p)), steps_description(p));
    std::fflush(stdout);
  }
  constexpr double trial_seconds = 1;
  const Trial trial = trial_run<D>(p, system(scene), trial_seconds);
  const bool all_pairs = !scene.multirate && p.coulomb == CoulombSum::direct && !p.cutoff;
  const std::vector<SheetRow> sheet = lab_sheet(p, draw(p, trial));
  if (json)
    fmt::print("{}\n", check_record(deck, sheet, plan_rows(plan(p, trial, all_pairs))));
  else
    fmt::print("{}{}", lab_sheet_text(sheet), plan_description(p, trial, all_pairs));
}

}  // namespace

void check_deck(const Arguments& a, const OwnPhysics& own) {
  Deck deck = read_deck(a.deck, a.overrides);
  read_field_map_of(deck);
  deck.parameters.system == 1 ? check<1>(deck, a.json, own) : check<3>(deck, a.json, own);
}

}  // namespace treejet
