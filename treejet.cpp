/// The front door: arguments -> deck -> scene -> run. No physics here.

#include <fmt/format.h>

#include <iostream>

#include "core/command_line.hpp"
#include "core/convert.hpp"
#include "core/deck.hpp"
#include "core/error.hpp"
#include "core/file_info.hpp"
#include "core/provenance.hpp"
#include "forces/coulomb.hpp"
#include "forces/coulomb_request.hpp"
#include "forces/field_command.hpp"
#include "forces/scene_description.hpp"
#include "integrators/choice.hpp"
#include "integrators/simulation.hpp"

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
void run(const Deck& deck, const Arguments& a) {
  const Parameters& p = deck.parameters;
  const Threads threads{a.threads > 0 ? a.threads : available_cores()};
  Scene<D> scene = compose<D>(p, threads);
  const auto existing = a.force ? OutputFile::Existing::replace : OutputFile::Existing::keep;
  Simulation<D> simulation(p, {scene.jet, scene.right_hand_side(), scene.nozzle, scene.collector},
                           {a.out, existing, a.quiet, provenance(deck, vector_path()), {1, threads.count}});
  if (!a.quiet) {
    fmt::print("{}\n{}\n{}{}", version_text(), deck.name, notes(deck),
               composition(scene.composed, scene.left_out));
    fmt::print("{}, {}; {}\n\n", name(chosen_scheme(p)), steps_description(p), threads_description(threads));
  }
  simulation.finish();
  if (!a.quiet) fmt::print("\n{}", simulation.summary());
}

template <int D>
void check(const Deck& deck) {
  const Scene<D> scene = compose<D>(deck.parameters, {1});
  fmt::print("{}: a complete deck\n{}{}{}", deck.name, notes(deck), scales_description(deck.parameters),
             composition(scene.composed, scene.left_out));
  fmt::print("{}, {}\n", name(chosen_scheme(deck.parameters)), steps_description(deck.parameters));
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
  const Deck deck = read_deck(a.deck, a.overrides);
  const bool straight = deck.parameters.system == 1;
  if (a.command == "check") {
    straight ? check<1>(deck) : check<3>(deck);
  } else {
    straight ? run<1>(deck, a) : run<3>(deck, a);
  }
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
