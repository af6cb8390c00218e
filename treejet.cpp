/// The front door: arguments -> deck -> scene -> run. No physics here.

#include <fmt/format.h>

#include <chrono>
#include <iostream>

#include "core/command_line.hpp"
#include "core/deck.hpp"
#include "core/error.hpp"
#include "core/outputs.hpp"
#include "core/progress.hpp"
#include "core/version.hpp"
#include "forces/coulomb.hpp"
#include "forces/coulomb_request.hpp"
#include "forces/field_command.hpp"
#include "forces/scene_description.hpp"
#include "integrators/choice.hpp"
#include "integrators/march.hpp"

namespace treejet {

std::string version_text() {
  const Version v = version();
  return fmt::format("treejet {} (git {}), {}, {} build, {} vectors", v.number, v.commit, v.compiler, v.build,
                     vector_path());
}

std::string notes(const Deck& deck) {
  std::string text;
  for (const auto& note : deck.notes) text += fmt::format("note: {}\n", note);
  return text;
}

template <int D>
void print_summary(const March<D>& march, const Jet<D>& jet, const Outputs<D>& outputs, double seconds) {
  const Effort& e = march.effort();
  fmt::print("\ndone in {:.3g} s: {} beads on the jet, {} inserted, {} arrived\n", seconds,
             jet.size() + jet.held, e.placed, e.removed);
  fmt::print(
      "{} evaluations of the forces in {} steps ({} rejected, {} made anew for an event), {:.3g} us each\n",
      e.evaluations, e.steps, e.rejected, e.redone, 1e6 * seconds / double(e.evaluations));
  for (const auto& line : outputs.summary()) fmt::print("{}\n", line);
}

template <int D>
void run(const Deck& deck, const Arguments& a) {
  const Parameters& p = deck.parameters;
  const Threads threads{a.threads > 0 ? a.threads : available_cores()};
  Scene<D> scene = compose<D>(p, threads);
  const auto scheme = stepper<D>(chosen_scheme(p));
  const auto control = step_control(p);
  const auto existing = a.force ? OutputFile::Existing::replace : OutputFile::Existing::keep;
  Outputs<D> outputs(p, scene.nozzle, scene.collector, {a.out, existing, a.quiet, scene.force_error()});
  March<D> march({scene.jet, scene.right_hand_side(), *scheme, *control, scene.nozzle, scene.collector,
                  p.events, p.tolerance.value_or(0), outputs.watchers()});
  if (!a.quiet) {
    fmt::print("{}\n{}\n{}{}", version_text(), deck.name, notes(deck),
               composition(scene.composed, scene.left_out));
    fmt::print("{}, {}; {}\n\n", name(chosen_scheme(p)), steps_description(p), threads_description(threads));
  }
  const auto started = std::chrono::steady_clock::now();
  march.to(p.final_time / scales(p).time);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!a.quiet) print_summary<D>(march, scene.jet, outputs, seconds);
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
