#include "integrators/run/run_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/output_file.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/subdomains.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/directory_lock.hpp"
#include "core/io/field_map_file.hpp"
#include "core/io/output_files.hpp"
#include "core/io/provenance.hpp"
#include "core/io/run_record.hpp"
#include "core/restart/origin.hpp"
#include "core/restart/resume.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/scene/scene_description.hpp"
#include "integrators/run/error_estimate.hpp"
#include "integrators/run/simulation.hpp"

namespace treejet {

namespace {

/// "2 ranks, each with the whole jet and 4 threads".
std::string workers_description(const Parameters& p, const Ranks& ranks, Threads threads) {
  if (ranks.size() == 1) return threads_description(threads);
  return fmt::format("{} ranks, each with {} and {}", ranks.size(),
                     p.parallel == ParallelData::distributed ? "a subdomain" : "the whole jet",
                     threads_description(threads));
}

/// Ranks see signals at different steps and have clocks of their own: the clock of the first one counts, and
/// all follow the strongest request.
class StopVote {
 public:
  StopVote(const Parameters& p, const Arguments& a, const Ranks& ranks)
      : ranks_(ranks),
        signals_(ranks.first() ? StopSignals::Setting{p.checkpoint, a.walltime} : StopSignals::Setting{}) {}

  StopRequest operator()() { return StopRequest{ranks_.greatest(static_cast<int>(signals_.stop_request()))}; }
  std::string reason() const { return signals_.reason(); }

 private:
  const Ranks& ranks_;
  StopSignals signals_;
};

/// Before anything is made: an old table is not to be replaced unasked. A run that goes on does not have the
/// jet of another any more that it once began with.
void expect_estimate_possible(const Parameters& p, const Arguments& a, const std::filesystem::path& table,
                              const std::string& begins_with) {
  expect_estimable(p);
  if (!a.resume.empty() && !begins_with.empty())
    throw InputError(
        fmt::format("--estimate-error: this run began with {}; expected --estimate-error of a "
                    "whole run: treejet run DECK --from ... --estimate-error",
                    begins_with));
  std::error_code error;
  if (!a.force && std::filesystem::exists(std::filesystem::symlink_status(table, error)))
    throw exists_already(table);
}

/// Runs the deck once more, finer, and writes how far the rows of the run in the directory are from that.
template <int D>
void estimate_error(const Parameters& p, const Arguments& a, const std::filesystem::path& directory,
                    Scene<D> scene, const OwnObservables<D>& own, const Ranks& ranks,
                    const std::function<bool()>& stop_here) {
  const std::string against = finer_description(p);
  if (!a.quiet) fmt::print("\nonce more, as {}\n", against);
  std::fflush(stdout);
  const auto second = rows_of_run<D>(finer(p), scene, own, stop_here);
  if (!ranks.first()) return;
  if (!second) {
    fmt::print(stderr, "treejet: the run is complete, its error is not estimated: stopped\n");
    return;
  }
  const TableOfRows first = read_rows(directory / "statdat.dat"), apart = difference(first, *second);
  const auto all = errors(first, apart);
  write_whole(directory / error_table_name, rows_text(apart, against));
  record_errors(directory, against, all);
  if (!a.quiet) fmt::print("{}{}\n", errors_text(all, against), (directory / error_table_name).string());
}

/// What a run begins with: the deck's initial jet, the same run's checkpoint, or the state of another.
struct Beginning {
  Checkpoint* resumed = nullptr;
  std::vector<std::string> changes = {};  ///< of the deck of a run that is extended
  Origin* origin = nullptr;
};

/// Empty without a map.
std::string map_name(const Parameters& p) {
  return p.map ? p.map->name() : std::string();
}

Provenance made(const Deck& deck, const OwnPhysics& own, const Beginning& from = {}) {
  Provenance p = provenance(deck, isa_name());
  if (!own.name.empty()) p.version += own_physics_mark + own.name;
  const std::string part = "begins with";
  if (from.origin) p.begins_with = description(*from.origin, deck.parameters);
  p.field_map = map_name(deck.parameters);
  if (from.resumed && from.resumed->state.has(part)) from.resumed->state.part(part, p.begins_with);
  return p;
}

/// What a run is made of; a jet that is begun with takes the place of the deck's initial one.
template <int D>
Scene<D> scene_of(const Parameters& p, Threads threads, const Ranks& ranks, const OwnPhysics& own,
                  const Beginning& from) {
  Scene<D> scene = compose<D>(p, threads, ranks, own_terms<D>(own, p));
  if (from.origin) scene.decomposition().take(scene.jet, jet_of<D>(*from.origin, p, scene.columns));
  return scene;
}

/// Above the table on the terminal.
template <int D>
void announce(const Deck& deck, const Scene<D>& scene, const Provenance& made_by, const Beginning& from,
              const std::string& workers) {
  const Parameters& p = deck.parameters;
  fmt::print("{}\n{}\n{}{}", program(made_by), deck.name, notes(deck),
             composition(scene.composed, scene.left_out));
  if (from.origin)
    fmt::print("begins with {}; {}\n", made_by.begins_with,
               steps_of(*from.origin, p) ? "its steps go on" : "its steps begin anew");
  fmt::print("{}, {}; {}\n\n", name(chosen_scheme(p)), steps_description(p), workers);
}

/// The files of the run that --force replaces which this one does not make: readers would take them for its
/// own.
std::vector<std::filesystem::path> left_by_replaced_run(const Parameters& p,
                                                        const std::filesystem::path& directory) {
  const auto is_in = [](const std::vector<OutputFileKind>& kinds, const std::string& name) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const OutputFileKind& k) { return k.name == name; });
  };
  std::vector<std::filesystem::path> left;
  for (const std::string& name : recorded_files(directory))
    if (is_in(all_output_files(), name) && !is_in(output_files(p), name)) left.push_back(directory / name);
  return left;
}

void remove_all(const std::vector<std::filesystem::path>& outdated) {
  std::error_code error;
  for (const auto& file : outdated) std::filesystem::remove(file, error);
}

template <int D>
int run(const Deck& deck, const Arguments& a, const Ranks& ranks, const OwnPhysics& own,
        const Beginning& from) {
  const Provenance made_by = made(deck, own, from);
  ranks.require_same(program(made_by), deck_description(deck.name, deck.text, deck.overrides) +
                                           made_by.begins_with + made_by.field_map);
  const Parameters& p = deck.parameters;
  const Threads each = threads(a, ranks);
  const std::string directory = from.resumed ? a.resume : a.out;
  StopVote stop(p, a, ranks);
  const std::filesystem::path error_table = std::filesystem::path(directory) / error_table_name;
  if (a.estimate_error) expect_estimate_possible(p, a, error_table, made_by.begins_with);
  Scene<D> scene = scene_of<D>(p, each, ranks, own, from);
  std::vector<std::filesystem::path> outdated;
  if (a.force && ranks.first()) outdated = left_by_replaced_run(p, directory);
  // errors of another run, or of a part of this one, would stand beside rows that they do not belong to
  if ((a.force || from.resumed) && ranks.first()) outdated.push_back(error_table);
  OutputSetting outputs{directory,          existing(a), a.quiet,
                        !ranks.first(),     made_by,     {ranks.size(), each.count},
                        scene.force_error()};
  outputs.changes = from.changes;
  Simulation<D> simulation(
      deck, system(scene),
      {outputs, [&stop] { return stop(); }, from.resumed, own_observables<D>(own),
       from.origin ? steps_of(*from.origin, p) : nullptr, [&ranks] { return ranks.times(); },
       [&ranks](std::span<double> numbers) {
         ranks.sum(numbers);
         for (double& number : numbers) number /= ranks.size();
       }});
  if (!a.quiet) announce(deck, scene, made_by, from, workers_description(p, ranks, each));
  remove_all(outdated);
  const auto started = std::chrono::steady_clock::now();
  if (!simulation.finish()) {
    ranks.greatest(stopped_early);  // no rank ends before the first one has written the checkpoint
    if (ranks.first())
      fmt::print(stderr, "treejet: stopped at t = {:.6g} s by {}; to go on: treejet run --resume {}\n",
                 simulation.t(), stop.reason(), for_shell(directory));
    return stopped_early;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!a.quiet) fmt::print("\n{}{}", simulation.summary(), times_description(ranks.times(), seconds));
  if (a.estimate_error)
    estimate_error<D>(p, a, directory, scene_of<D>(finer(p), each, ranks, own, from), own_observables<D>(own),
                      ranks, [&stop] { return stop() == StopRequest::stop; });
  return 0;
}

/// Where a run that goes on has had its map, from wherever it is gone on with, if it is still there.
void find_map_again(Parameters& p, Checkpoint& resumed) {
  std::string place;
  std::error_code error;
  if (resumed.state.has(field_map_place)) resumed.state.part(field_map_place, place);
  if (std::filesystem::exists(place, error)) p.field_map = place;
}

/// A run that goes on has the map that it began with.
void expect_same_map(const Parameters& p, Checkpoint& resumed) {
  std::string before;
  if (resumed.state.has("field map")) resumed.state.part("field map", before);
  if (const std::string now = map_name(p); before != now)
    throw InputError(fmt::format("the run began with {}, and this is {}",
                                 before.empty() ? "no field map" : before, now.empty() ? "none" : now));
}

/// A run that goes on is cut as it was. Observables of a caller's own see the whole jet.
ParallelData data_of_ranks(const Parameters& p, const Ranks& ranks, const OwnPhysics& own,
                           const Beginning& from) {
  using enum ParallelData;
  if (!own.observables.empty()) {
    if (p.parallel == distributed)
      throw InputError(
          fmt::format("parallel: expected replicated with the observables of {}, which see the "
                      "whole jet, found distributed",
                      own.name));
    return replicated;
  }
  if (p.parallel != automatic) return p.parallel;
  if (from.resumed) return from.resumed->records > 0 ? distributed : replicated;
  if (!from.origin) return data_of_ranks(p, ranks.size());
  const bool was_cut = from.origin->checkpoint && from.origin->checkpoint->records > 0;
  return was_cut && obstacles_to_subdomains(p).empty() ? distributed : replicated;
}

int run(Deck deck, const Arguments& a, const Ranks& ranks, const OwnPhysics& own,
        const Beginning& from = {}) {
  deck.parameters.parallel = data_of_ranks(deck.parameters, ranks, own, from);
  if (from.resumed) find_map_again(deck.parameters, *from.resumed);
  read_field_map_of(deck);
  if (from.resumed) expect_same_map(deck.parameters, *from.resumed);
  const bool straight = deck.parameters.system == 1;
  return straight ? run<1>(deck, a, ranks, own, from) : run<3>(deck, a, ranks, own, from);
}

/// Whether the run in a directory has come to its end. FileError if another process is at it.
bool is_completed(const std::string& directory, const Ranks& ranks) {
  std::error_code error;
  if (ranks.first() && std::filesystem::is_directory(directory, error)) DirectoryLock{directory};
  return has_completed(directory) &&
         !std::filesystem::exists(std::filesystem::path(directory) / "checkpoint", error);
}

int already_at_its_end(const Arguments& a, const Ranks& ranks) {
  if (ranks.first()) fmt::print("{}: the run is already at its end\n", a.resume);
  return 0;
}

int run_from(const Arguments& a, const Ranks& ranks, const OwnPhysics& own) {
  Origin source = origin(a.from);
  std::error_code error;
  if (std::filesystem::equivalent(source.file.parent_path() / ".", a.out, error))
    throw InputError(fmt::format("--from {}: the run there is left as it is; name another --out", a.from));
  return run(read_deck(a.deck, a.overrides), a, ranks, own, {.origin = &source});
}

/// All ranks, which go on from the same checkpoint.
Readers readers(const Ranks& ranks) {
  return {ranks.rank(), ranks.size(), [ranks](bool sound) { return ranks.greatest(sound ? 0 : 1) == 0; }};
}

int resume(const Arguments& a, const Ranks& ranks, const OwnPhysics& own) {
  const bool completed = is_completed(a.resume, ranks);
  if (completed && a.overrides.empty()) return already_at_its_end(a, ranks);
  const bool with_deck = !a.deck.empty();  // whose overrides say the same as the checkpoint
  Resumption found = resumption(a.resume, version_text(own),
                                with_deck ? std::vector<std::string>() : a.overrides, readers(ranks));
  if (ranks.first())
    for (const auto& w : found.warnings) fmt::print(stderr, "treejet: warning: {}\n", printable(w));
  if (with_deck) expect_same(read_deck(a.deck, a.overrides), found.deck);
  if (completed && !found.extended) return already_at_its_end(a, ranks);
  const auto changes = found.extended ? a.overrides : std::vector<std::string>();
  return run(found.deck, a, ranks, own, {.resumed = &found.checkpoint, .changes = changes});
}

}  // namespace

std::string version_text(const OwnPhysics& own) {
  return program(made({}, own));
}

Threads threads(const Arguments& a, const Ranks& ranks) {
  const Threads threads{a.threads > 0 ? a.threads : ranks.threads_each()};
  const std::string crowding = ranks.crowding(threads);
  if (!crowding.empty()) fmt::print(stderr, "treejet: warning: {}\n", crowding);
  return threads;
}

OutputFile::Existing existing(const Arguments& a) {
  return a.force ? OutputFile::Existing::replace : OutputFile::Existing::keep;
}

int run_deck(const Arguments& a, const Ranks& ranks, const OwnPhysics& own) {
  if (!a.resume.empty()) return resume(a, ranks, own);
  if (!a.from.empty()) return run_from(a, ranks, own);
  return run(read_deck(a.deck, a.overrides), a, ranks, own);
}

}  // namespace treejet
