#include "integrators/run/check_deck.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/deck/deck.hpp"
#include "forces/scene/scene_description.hpp"
#include "integrators/run/trial_run.hpp"

namespace treejet {

namespace {

template <int D>
void check(const Deck& deck) {
  const Parameters& p = deck.parameters;
  expect_feasible_trial(p);
  Scene<D> scene = compose<D>(p, {available_cores()});
  fmt::print("{}: a complete deck\n{}{}{}", deck.name, notes(deck), scales_description(p),
             composition(scene.composed, scene.left_out));
  fmt::print("{}, {}\n", name(chosen_scheme(p)), steps_description(p));
  std::fflush(stdout);
  constexpr double trial_seconds = 1;
  const Trial trial = trial_run<D>(p, system(scene), trial_seconds);
  const bool all_pairs = !scene.multirate && p.coulomb == CoulombSum::direct && !p.cutoff;
  fmt::print("{}", plan_description(p, trial, all_pairs));
}

}  // namespace

void check_deck(const Arguments& a) {
  const Deck deck = read_deck(a.deck, a.overrides);
  deck.parameters.system == 1 ? check<1>(deck) : check<3>(deck);
}

}  // namespace treejet
