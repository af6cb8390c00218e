/// The front door of the validation harness: which study, where its tables go, whether all its claims hold.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "validation/distributed_run.hpp"
#include "validation/scaling_run.hpp"
#include "validation/studies.hpp"

namespace {

constexpr const char* lesson = R"(
Each study prints tables, writes them to DIR as CSV and draws what can be drawn with validation/plot_validation.py.
Exit codes: 0 all claims hold, 1 one does not, 2 arguments, 4 files.)";

int draw(const std::string& directory) {
  const auto command =
      fmt::format("/usr/bin/python3 '{}/validation/plot_validation.py' '{}'", TREEJET_SOURCE_DIR, directory);
  std::fflush(stdout);
  return std::system(command.c_str());
}

int run(const std::string& study, const std::string& directory, bool quick) {
  treejet::Report report(directory, quick);
  if (study == "time") {
    treejet::study_time_reversal(report);
    treejet::study_reference_values(report);
    treejet::study_work_precision(report);
  } else if (study == "restart") {
    treejet::study_restart(report);
  } else if (study == "scaling") {
    treejet::study_scaling(report);
  } else if (study == "distributed") {
    treejet::study_distributed(report);
  } else if (study == "stability") {
    treejet::study_stiffness(report);
    treejet::study_extreme_cases(report);
  } else {
    treejet::study_coulomb_accuracy(report);
    treejet::study_coulomb_cost(report);
  }
  const int failures = report.conclude("checks_" + study);
  if (study != "restart" && draw(directory) != 0)
    fmt::print(stderr, "treejet-validate: the pictures could not be drawn\n");
  if (failures > 0) fmt::print("\n{} claims do not hold\n", failures);
  return failures > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures how far Treejet's numbers can be trusted", "treejet-validate"};
  app.require_subcommand(1);
  app.footer(lesson);
  std::string directory = "results/validation";
  bool quick = false;
  for (const auto& [study, meaning] :
       {std::pair{"time", "Error against work, orders of convergence, time reversal"},
        std::pair{"stability", "Largest stable steps, extreme cases"},
        std::pair{"restart", "Runs killed at random moments and resumed"},
        std::pair{"scaling", "Speedup and efficiency of ranks and threads"},
        std::pair{"distributed", "A chain held in pieces: bytes, memory, accuracy, a model of many ranks"},
        std::pair{"coulomb",
                  "The Coulomb field: error against time, crossover with the direct sum, growth"}}) {
    auto& command = *app.add_subcommand(study, meaning);
    command.add_option("--out", directory, "directory of tables and pictures, made if missing")
        ->capture_default_str();
    command.add_flag("--quick", quick, "fewer and shorter runs: a minute instead of several");
  }
  treejet::ScalingRun scaling_run;
  bool tree = false;
  auto& single =
      *app.add_subcommand("scaling-run", "One measured run of the scaling study, in ranks or alone");
  single.add_option("--refinement", scaling_run.refinement, "pieces of an element")
      ->check(CLI::Range(1, 100000));
  single.add_option("--threads", scaling_run.threads, "threads of each rank")->check(CLI::Range(1, 4096));
  single.add_option("--evaluations", scaling_run.evaluations, "how many to measure")
      ->check(CLI::Range(1, 1000000000));
  single.add_flag("--tree", tree, "Coulomb sum by the tree");
  treejet::DistributedRun distributed_run;
  auto& pieces =
      *app.add_subcommand("distributed-run", "One measured field of a chain held in pieces, by ranks");
  pieces.add_option("--chain", distributed_run.chain, "jet or coil")->check(CLI::IsMember({"jet", "coil"}));
  pieces.add_option("--points", distributed_run.points, "of the whole chain")
      ->check(CLI::Range(1, 100000000));
  pieces.add_option("--accuracy", distributed_run.accuracy, "of the field")->check(CLI::Range(1e-12, 0.1));
  pieces.add_option("--threads", distributed_run.threads, "threads of each rank")->check(CLI::Range(1, 4096));
  pieces.add_option("--evaluations", distributed_run.evaluations, "the quickest of so many counts")
      ->check(CLI::Range(1, 1000000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  treejet::Ranks ranks;
  try {
    if (pieces.parsed()) {
      ranks = treejet::join_ranks();
      fmt::print("{}", text(measure(distributed_run, ranks)));
      return 0;
    }
    if (single.parsed()) {
      ranks = treejet::join_ranks();
      if (tree) scaling_run.sum = treejet::CoulombSum::tree;
      fmt::print("{}", text(measure(scaling_run, ranks)));
      return 0;
    }
    return run(app.get_subcommands().front()->get_name(), directory, quick);
  } catch (const treejet::Error& e) {
    return ranks.fail(e.exit_code(), fmt::format("treejet-validate: {}\n", e.what()));
  }
}
