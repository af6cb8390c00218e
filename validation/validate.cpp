/// The front door of the validation harness: which studies, where their tables go, whether all claims hold.

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <functional>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/version.hpp"
#include "core/observe/progress.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "validation/support/deck_folder.hpp"
#include "validation/support/deck_run.hpp"
#include "validation/support/distributed_run.hpp"
#include "validation/support/installation.hpp"
#include "validation/support/machine.hpp"
#include "validation/support/scaling_run.hpp"
#include "validation/support/studies.hpp"

namespace {

using treejet::Report;

constexpr const char* lesson = R"(
Each study prints tables and claims with their verdicts, writes them to DIR as CSV, draws them and puts all of it into
DIR/report.html, a page that needs no other file. `all` is the report of a release, `all --quick` that of every change.
Exit codes: 0 all claims hold, 1 one does not, 2 arguments, 4 files.)";

struct Study {
  std::string name, meaning;
  std::vector<std::function<void(Report&)>> parts;
  double quick, full;  ///< share of the time of all, as once measured; any unit
};

const std::vector<Study> studies = {
    {"convergence", "Point charges against the slender self-field", {treejet::study_convergence}, 3, 30},
    {"paper",
     "The paper's cases, figure by figure, beside what is published",
     {treejet::study_single_bead, treejet::study_straight_jet, treejet::study_pvp_jet,
      treejet::study_performance},
     15,
     40},
    {"jetspin",
     "JETSPIN's example decks beside what their authors record",
     {treejet::study_jetspin_records},
     0,
     0},
    {"whipping", "Frequency and wavelength of the whipping", {treejet::study_whipping}, 1, 10},
    {"resolution", "Case 3 with longer and shorter elements", {treejet::study_resolution}, 2, 15},
    {"time",
     "Error against work, orders of convergence, time reversal",
     {treejet::study_time_reversal, treejet::study_promised_accuracy, treejet::study_reference_values,
      treejet::study_work_precision},
     23,
     250},
    {"stability",
     "Largest stable steps, extreme cases",
     {treejet::study_stiffness, treejet::study_extreme_cases},
     5,
     60},
    {"coulomb",
     "The Coulomb field: error against time, crossover with the direct sum, growth",
     {treejet::study_coulomb_accuracy, treejet::study_coulomb_cost},
     20,
     900},
    {"scaling", "Speedup and efficiency of ranks and threads", {treejet::study_scaling}, 5, 300},
    {"distributed",
     "A chain held in subdomains: bytes, memory, accuracy, a model of many ranks",
     {treejet::study_distributed},
     6,
     400},
    {"determinism", "The same bytes on any number of ranks and threads", {treejet::study_determinism}, 6, 30},
    {"restart", "Runs killed at random moments and resumed", {treejet::study_restart}, 8, 120}};

constexpr int most_threads = 4096;
constexpr std::int64_t most_steps = 1'000'000'000;

/// Of `treejet-validate scaling`: with a deck, that one in the place of case 3.
void add_options(CLI::App& scaling, treejet::DeckScaling& asked) {
  auto* deck = scaling.add_option("--deck", asked.deck, "this deck instead of case 3 at several sizes")
                   ->check(CLI::ExistingFile);
  std::vector<CLI::Option*> of_deck;
  const auto numbers = [&](const char* name, std::vector<int>& list, const char* meaning) {
    of_deck.push_back(
        scaling.add_option(name, list, meaning)->delimiter(',')->check(CLI::Range(1, most_threads)));
    return of_deck.back();
  };
  auto* workers =
      numbers("--workers", asked.workers,
              "1,2,4: each number as threads of one rank and as ranks (default: up to the cores)");
  numbers("--ranks", asked.ranks, "1,2: numbers of ranks, each with every number of threads")
      ->excludes(workers);
  numbers("--threads", asked.threads, "1,2: numbers of threads of a rank")->excludes(workers);
  of_deck.push_back(scaling.add_option("--data", asked.data, "of ranks: replicated, distributed or both")
                        ->check(CLI::IsMember({"replicated", "distributed", "both"})));
  of_deck.push_back(
      scaling
          .add_option("--steps", asked.steps, "of each run, after a warm-up (default: what --seconds allow)")
          ->check(CLI::Range(std::int64_t{1}, most_steps)));
  of_deck.push_back(scaling
                        .add_option("--seconds", asked.seconds,
                                    "in which one worker's steps are counted, without --steps (10)")
                        ->check(CLI::Range(0.001, 1e6)));
  of_deck.push_back(scaling.add_option("--turns", asked.turns, "of all teams; medians are shown (3)")
                        ->check(CLI::Range(1, 1000)));
  of_deck.push_back(scaling.add_option(
      "--from", asked.from, "begin with the state of the run in this directory, as treejet run does"));
  of_deck.push_back(scaling.add_option("--set", asked.overrides, "a directive that replaces the deck's")
                        ->allow_extra_args(false));
  for (CLI::Option* o : of_deck) o->needs(deck);
}

/// Of a part of that, in ranks or alone.
void add_options(CLI::App& command, treejet::DeckRun& run) {
  command.add_option("DECK", run.deck)->required();
  command.add_option("--threads", run.threads, "threads of each rank")->check(CLI::Range(1, most_threads));
  command.add_option("--steps", run.steps, "how many to measure")
      ->check(CLI::Range(std::int64_t{1}, most_steps));
  command.add_option("--seconds", run.seconds, "no step begins later; for one rank")
      ->check(CLI::Range(0.001, 1e9));
  command.add_option("--from", run.from, "begin with the state of the run in this directory");
  command.add_option("--set", run.overrides, "a directive that replaces the deck's")->allow_extra_args(false);
  command.add_option("--out", run.directory, "for the run's files")->required();
  command.add_flag("--subdomains", run.subdomains, "the chain cut in one subdomain a rank");
}

/// What made the report and where, a line each.
void write_provenance(const std::filesystem::path& directory, const std::string& command) {
  std::ofstream file(directory / "provenance.txt");
  const auto v = treejet::version();
  file << fmt::format("treejet {} (git {}), {}, {} build, {} vectors\n", v.number, v.commit, v.compiler,
                      v.build, treejet::isa_name());
  file << fmt::format("{}, {} cores\n", treejet::processor_name(), treejet::physical_cores());
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  file << fmt::format("{}, {:%Y-%m-%d %H:%M} UTC\n", command, fmt::gmtime(now));
  if (!file) throw treejet::FileError((directory / "provenance.txt").string() + ": cannot be written");
}

/// Draws the pictures and writes the page.
bool publish(const std::string& directory) {
  std::fflush(stdout);
  return std::system(
             fmt::format("/usr/bin/python3 {} {}",
                         treejet::for_shell(treejet::source_tree() + "/validation/pictures/report.py"),
                         treejet::for_shell(directory))
                 .c_str()) == 0;
}

/// A study that breaks off is a claim that does not hold; the others go on.
void run(const Study& study, Report& report) try {
  for (const auto& part : study.parts) part(report);
} catch (const treejet::FileError&) {
  throw;
} catch (const treejet::Error& e) {
  report.check(fmt::format("{} ends: {}", study.name, e.what()), std::nan(""), 1, 1);
}

int run(const std::vector<Study>& chosen, Report& report) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto share = [&](const Study& s) { return report.quick ? s.quick : s.full; };
  double left = 0, done = 0;
  for (const Study& s : chosen) left += share(s);
  for (const Study& s : chosen) {
    run(s, report);
    done += share(s), left -= share(s);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (chosen.size() > 1)
      fmt::print(stderr, "{} done after {}; all of it: about {} left\n", s.name,
                 treejet::duration_text(seconds), treejet::duration_text(seconds * left / done));
  }
  const int failures = report.conclude();
  const bool published = publish(report.directory().string());
  if (!published) fmt::print(stderr, "treejet-validate: the report could not be made whole\n");
  if (failures > 0) fmt::print("\n{} claims do not hold\n", failures);
  return failures > 0 ? 1 : published ? 0 : 4;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures how far Treejet's numbers can be trusted", "treejet-validate"};
  app.require_subcommand(1);
  app.footer(lesson);
  std::string directory = "results/validation";
  bool quick = false, full = false;
  std::filesystem::path jetspin_decks;
  treejet::DeckScaling deck_scaling;
  const auto add = [&](const std::string& name, const std::string& meaning) {
    auto& command = *app.add_subcommand(name, meaning);
    command.add_option("--out", directory, "directory of tables, pictures and report, made if missing")
        ->capture_default_str();
    if (name == "all" || name == "jetspin")
      command.add_option("--decks", jetspin_decks, "folder of JETSPIN's example decks, to judge them, too")
          ->check(CLI::ExistingDirectory);
    if (name == "scaling") add_options(command, deck_scaling);
    auto* q = command.add_flag("--quick", quick, "fewer and shorter runs");
    command.add_flag("--full", full, "the whole, which is the default")->excludes(q);
  };
  add("all", "All of the following, one report");
  for (const Study& s : studies) add(s.name, s.meaning);
  treejet::DeckFolder folder;
  auto& decks =
      *app.add_subcommand("decks", "Runs a folder of decks, each for a while: what it needs and gives");
  decks.add_option("DIR", folder.directory, "folder of decks, *.dat")->required();
  decks.add_option("--seconds", folder.seconds, "of the processor for each")->capture_default_str();
  decks.add_flag("--as-written", folder.as_written, "by the decks' own time steps, not by tolerance 1e-6");
  decks.add_option("--out", directory, "directory of the table")->capture_default_str();
  treejet::ScalingRun scaling_run;
  bool tree = false;
  auto& single =
      *app.add_subcommand("scaling-run", "One measured run of the scaling study, in ranks or alone");
  single.add_option("--refinement", scaling_run.refinement, "parts of an element")
      ->check(CLI::Range(1, 100000));
  single.add_option("--threads", scaling_run.threads, "threads of each rank")->check(CLI::Range(1, 4096));
  single.add_option("--evaluations", scaling_run.evaluations, "how many to measure")
      ->check(CLI::Range(1, 1000000000));
  single.add_flag("--tree", tree, "Coulomb sum by the tree");
  single.add_flag("--subdomains", scaling_run.subdomains, "the chain cut in one subdomain a rank");
  treejet::DeckRun deck_run;
  auto& one_deck = *app.add_subcommand("deck-run", "One measured stretch of a deck's run, in ranks or alone");
  add_options(one_deck, deck_run);
  treejet::DistributedRun distributed_run;
  auto& subdomains =
      *app.add_subcommand("distributed-run", "One measured field of a chain held in subdomains, by ranks");
  subdomains.add_option("--chain", distributed_run.chain, "jet or coil")
      ->check(CLI::IsMember({"jet", "coil"}));
  subdomains.add_option("--points", distributed_run.points, "of the whole chain")
      ->check(CLI::Range(1, 100000000));
  subdomains.add_option("--accuracy", distributed_run.accuracy, "of the field")
      ->check(CLI::Range(1e-12, 0.1));
  subdomains.add_option("--threads", distributed_run.threads, "threads of each rank")
      ->check(CLI::Range(1, 4096));
  subdomains.add_option("--evaluations", distributed_run.evaluations, "the quickest of so many counts")
      ->check(CLI::Range(1, 1000000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  treejet::Ranks ranks;
  try {
    if (subdomains.parsed()) {
      ranks = treejet::join_ranks();
      fmt::print("{}", text(measure(distributed_run, ranks)));
      return 0;
    }
    if (decks.parsed()) {
      Report report(directory, quick);
      run_decks(folder, report);
      return 0;
    }
    if (one_deck.parsed()) {
      ranks = treejet::join_ranks();
      fmt::print("{}", text(measure(deck_run, ranks)));
      return 0;
    }
    if (single.parsed()) {
      ranks = treejet::join_ranks();
      if (tree) scaling_run.sum = treejet::CoulombSum::tree;
      fmt::print("{}", text(measure(scaling_run, ranks)));
      return 0;
    }
    if (!deck_scaling.deck.empty()) require_valid(deck_scaling);
    const std::string name = app.get_subcommands().front()->get_name();
    std::vector<Study> chosen;
    for (const Study& s : studies)
      if (name == "all" || name == s.name) chosen.push_back(s);
    Report report(directory, quick);
    report.decks = jetspin_decks;
    std::string command = fmt::format("treejet-validate {}{}", name, quick ? " --quick" : "");
    if (!deck_scaling.deck.empty()) {
      command += " --deck " + deck_scaling.deck;
      chosen = {{"scaling", "", {[&](Report& r) { study_scaling_of(deck_scaling, r); }}, 1, 1}};
    }
    write_provenance(directory, command);
    return run(chosen, report);
  } catch (const treejet::Error& e) {
    return ranks.fail(e.exit_code(), fmt::format("treejet-validate: {}\n", e.what()));
  }
}
