/// The front door: arguments -> deck -> scene -> run. No physics here.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <iostream>

#include "core/base/error.hpp"
#include "core/commands/command_line.hpp"
#include "core/commands/convert.hpp"
#include "core/commands/file_info.hpp"
#include "core/deck/deck.hpp"
#include "core/io/provenance.hpp"
#include "core/restart/resume.hpp"
#include "forces/coulomb/command/field_command.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/scene/coulomb_settings.hpp"
#include "forces/scene/scene_description.hpp"
#include "integrators/run/simulation.hpp"
#include "integrators/run/trial_run.hpp"
#include "integrators/schemes/scheme_registry.hpp"

namespace treejet {

std::string version_text() {
  return program(provenance({}, isa_name()));
}

/// "2 ranks, 4 threads each".
std::string workers_description(const Ranks& ranks, Threads threads) {
  if (ranks.size() == 1) return threads_description(threads);
  return fmt::format("{} ranks, each with {}", ranks.size(), threads_description(threads));
}

/// The threads of each rank; warns where they have too few cores.
Threads threads(const Arguments& a, const Ranks& ranks) {
  const Threads threads{a.threads > 0 ? a.threads : ranks.threads_each()};
  const std::string crowding = ranks.crowding(threads);
  if (!crowding.empty()) fmt::print(stderr, "treejet: warning: {}\n", crowding);
  return threads;
}

OutputFile::Existing existing(const Arguments& a) {
  return a.force ? OutputFile::Existing::replace : OutputFile::Existing::keep;
}

template <int D>
int run(const Deck& deck, const Arguments& a, const Ranks& ranks, Checkpoint* checkpoint) {
  const Provenance made_by = provenance(deck, isa_name());
  ranks.require_same(program(made_by), deck_description(deck.name, deck.text, deck.overrides));
  const Parameters& p = deck.parameters;
  const Threads each = threads(a, ranks);
  const std::string directory = checkpoint ? a.resume : a.out;
  // ranks meet signals at different steps and have clocks of their own: the first one's clock counts, and all
  // follow the strongest wish
  std::optional<StopSignals> stop_signals;
  if (p.parallel == ParallelData::replicated)
    stop_signals.emplace(ranks.first() ? StopSignals::Setting{p.checkpoint, a.walltime}
                                       : StopSignals::Setting{});
  else if (a.walltime)
    throw InputError("--walltime needs a checkpoint, and parallel distributed writes none");
  const auto stop_request = [&] {
    return stop_signals ? StopRequest{ranks.greatest(static_cast<int>(stop_signals->stop_request()))}
                        : StopRequest::go_on;
  };
  Scene<D> scene = compose<D>(p, each, ranks);
  Simulation<D> simulation(
      deck, {scene.jet, scene.right_hand_side(), scene.nozzle, scene.collector, scene.decomposition()},
      {{directory,
        existing(a),
        a.quiet,
        !ranks.first(),
        made_by,
        {ranks.size(), each.count},
        scene.force_error()},
       stop_request,
       checkpoint});
  if (!a.quiet) {
    fmt::print("{}\n{}\n{}{}", program(made_by), deck.name, notes(deck),
               composition(scene.composed, scene.left_out));
    fmt::print("{}, {}; {}\n\n", name(chosen_scheme(p)), steps_description(p),
               workers_description(ranks, each));
  }
  const auto started = std::chrono::steady_clock::now();
  if (!simulation.finish()) {
    ranks.greatest(stopped_early);  // no rank ends before the first one has written the checkpoint
    if (ranks.first())
      fmt::print(stderr, "treejet: stopped at t = {:.6g} s by {}; to go on: treejet run --resume {}\n",
                 simulation.t(), stop_signals->reason(), directory);
    return stopped_early;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!a.quiet) fmt::print("\n{}{}", simulation.summary(), times_description(ranks.times(), seconds));
  return 0;
}

int run(const Deck& deck, const Arguments& a, const Ranks& ranks, Checkpoint* checkpoint = nullptr) {
  const bool straight = deck.parameters.system == 1;
  return straight ? run<1>(deck, a, ranks, checkpoint) : run<3>(deck, a, ranks, checkpoint);
}

int resume(const Arguments& a, const Ranks& ranks) {
  Resumption stopped = resumption(a.resume, version_text());
  if (ranks.first())
    for (const auto& w : stopped.warnings) fmt::print(stderr, "treejet: warning: {}\n", w);
  if (!a.deck.empty()) expect_same(read_deck(a.deck, a.overrides), stopped.deck);
  return run(stopped.deck, a, ranks, &stopped.checkpoint);
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
  const Trial trial = trial_run<D>(
      p, {scene.jet, scene.right_hand_side(), scene.nozzle, scene.collector, scene.decomposition()},
      trial_seconds);
  const bool all_pairs = !scene.multirate && p.coulomb == CoulombSum::direct && !p.cutoff;
  fmt::print("{}", plan_description(p, trial, all_pairs));
}

int main(const Arguments& a, const Ranks& ranks) {
  if (a.command == "template") return fmt::print("{}", deck_template()), 0;
  if (a.command == "reference") return fmt::print("{}\n{}", directive_reference(), key_reference()), 0;
  if (a.command == "field") {
    run({a.points, a.field_out, coulomb_request(a.coulomb, /*points_move*/ false), threads(a, ranks), ranks,
         a.repeat, a.compare, a.json},
        std::cout);
    return 0;
  }
  if (a.command == "convert")
    return fmt::print("{}\n", convert({a.file, a.format, a.converted, existing(a)})), 0;
  if (a.command == "info") return fmt::print("{}", file_info(a.file)), 0;
  if (!a.resume.empty()) return resume(a, ranks);
  const Deck deck = read_deck(a.deck, a.overrides);
  if (a.command == "run") return run(deck, a, ranks);
  deck.parameters.system == 1 ? check<1>(deck) : check<3>(deck);
  return 0;
}

}  // namespace treejet

int main(int argc, char** argv) {
  treejet::Ranks ranks;
  const auto fail = [&](int exit_code, const char* what) {
    return ranks.fail(exit_code, fmt::format("treejet: {}\n", what));
  };
  try {
    ranks = treejet::join_ranks();
    const auto arguments = treejet::command_line(argc, argv, treejet::version_text());
    return arguments ? treejet::main(*arguments, ranks) : 0;
  } catch (const treejet::Error& e) {
    return fail(e.exit_code(), e.what());
  } catch (const treejet::LaunchError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, e.what());
  }
}
