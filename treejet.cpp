/// The front door: arguments -> deck -> scene -> run. No physics here.

#include <fmt/format.h>

#include <cstdio>
#include <iostream>

#include "core/command_line.hpp"
#include "core/convert.hpp"
#include "core/deck.hpp"
#include "core/error.hpp"
#include "core/file_info.hpp"
#include "core/provenance.hpp"
#include "core/resumption.hpp"
#include "forces/coulomb.hpp"
#include "forces/coulomb_request.hpp"
#include "forces/field_command.hpp"
#include "forces/scene_description.hpp"
#include "integrators/choice.hpp"
#include "integrators/simulation.hpp"
#include "integrators/trial_run.hpp"

namespace treejet {

std::string version_text() {
  return program(provenance({}, vector_path()));
}

std::string notes(const Deck& deck) {
  std::string text;
  for (const auto& note : deck.notes) text += fmt::format("note: {}\n", note);
  return text;
}

template <int D>
int run(const Deck& deck, const Arguments& a, Checkpoint* checkpoint) {
  const Parameters& p = deck.parameters;
  const Threads threads{a.threads > 0 ? a.threads : available_cores()};
  const std::string directory = checkpoint ? a.resume : a.out;
  const auto existing = checkpoint ? OutputFile::Existing::resume
                        : a.force  ? OutputFile::Existing::replace
                                   : OutputFile::Existing::keep;
  Interruption interruption({p.checkpoint, a.walltime});
  Scene<D> scene = compose<D>(p, threads);
  Simulation<D> simulation(
      deck, {scene.jet, scene.right_hand_side(), scene.nozzle, scene.collector},
      {{directory, existing, a.quiet, provenance(deck, vector_path()), {1, threads.count}},
       version_text(),
       [&] { return interruption.wish(); }});
  if (!a.quiet) {
    fmt::print("{}\n{}\n{}{}", version_text(), deck.name, notes(deck),
               composition(scene.composed, scene.left_out));
    fmt::print("{}, {}; {}\n\n", name(chosen_scheme(p)), steps_description(p), threads_description(threads));
  }
  if (checkpoint) simulation.resume(*checkpoint);
  if (!simulation.finish()) {
    fmt::print(stderr, "treejet: stopped at t = {:.6g} s by {}; to go on: treejet run --resume {}\n",
               simulation.t(), interruption.reason(), directory);
    return stopped_early;
  }
  if (!a.quiet) fmt::print("\n{}", simulation.summary());
  return 0;
}

int resume(const Arguments& a) {
  Resumption stopped = resumption(a.resume, version_text());
  for (const auto& w : stopped.warnings) fmt::print(stderr, "treejet: warning: {}\n", w);
  if (!a.deck.empty()) expect_same(read_deck(a.deck, a.overrides), stopped.deck);
  const bool straight = stopped.deck.parameters.system == 1;
  return straight ? run<1>(stopped.deck, a, &stopped.checkpoint)
                  : run<3>(stopped.deck, a, &stopped.checkpoint);
}

template <int D>
void check(const Deck& deck) {
  const Parameters& p = deck.parameters;
  Scene<D> scene = compose<D>(p, {available_cores()});
  fmt::print("{}: a complete deck\n{}{}{}", deck.name, notes(deck), scales_description(p),
             composition(scene.composed, scene.left_out));
  fmt::print("{}, {}\n", name(chosen_scheme(p)), steps_description(p));
  std::fflush(stdout);
  constexpr double trial_seconds = 1;
  const Trial trial =
      trial_run<D>(p, {scene.jet, scene.right_hand_side(), scene.nozzle, scene.collector}, trial_seconds);
  const bool all_pairs = !scene.two_rates && p.coulomb == CoulombSum::direct && !p.cutoff;
  fmt::print("{}", plan_description(p, trial, all_pairs));
}

int main(const Arguments& a) {
  if (a.command == "template") return fmt::print("{}", deck_template()), 0;
  if (a.command == "reference") return fmt::print("{}\n{}", directive_reference(), key_reference()), 0;
  if (a.command == "field") {
    const int threads = a.threads > 0 ? a.threads : available_cores();
    run({a.points, a.field_out, coulomb_request(a.coulomb), threads, a.repeat, a.compare, a.json}, std::cout);
    return 0;
  }
  const auto existing = a.force ? OutputFile::Existing::replace : OutputFile::Existing::keep;
  if (a.command == "convert")
    return fmt::print("{}\n", convert({a.file, a.format, a.converted, existing})), 0;
  if (a.command == "info") return fmt::print("{}", file_info(a.file)), 0;
  if (!a.resume.empty()) return resume(a);
  const Deck deck = read_deck(a.deck, a.overrides);
  const bool straight = deck.parameters.system == 1;
  if (a.command == "run") return straight ? run<1>(deck, a, nullptr) : run<3>(deck, a, nullptr);
  straight ? check<1>(deck) : check<3>(deck);
  return 0;
}

}  // namespace treejet

int main(int argc, char** argv) {
  try {
    const auto line = treejet::command_line(argc, argv, treejet::version_text());
    return line.arguments ? treejet::main(*line.arguments) : line.exit_code;
  } catch (const treejet::Error& e) {
    fmt::print(stderr, "treejet: {}\n", e.what());
    return e.exit_code();
  } catch (const std::exception& e) {
    fmt::print(stderr, "treejet: {}\n", e.what());
    return 1;
  }
}
