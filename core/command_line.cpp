#include "core/command_line.hpp"

#include <CLI/CLI.hpp>

namespace treejet {

namespace {

constexpr const char* lesson = R"(
A deck is a text file of directives in CGS units, as JETSPIN's input.dat. Start from a working one:
  treejet template > input.dat         a commented deck with every directive
  treejet check input.dat              what it composes, without running it
  treejet run input.dat --out results  run it; then look at it:
  python3 validation/plot_run.py results
Any directive can be replaced for one run:
  treejet run input.dat --out r12 --set "external potential 40.03" --set "final time 0.1"

Exit codes: 0 done, 2 deck or arguments, 3 numerical failure, 4 files.)";

void add_deck(CLI::App& command, Arguments& a) {
  command.add_option("DECK", a.deck, "the deck, e.g. examples/pvp/input.dat")->required();
  command
      .add_option("--set", a.overrides,
                  "a directive with its value that replaces the deck's, e.g. "
                  "--set \"final time 0.1\"; may be repeated")
      ->allow_extra_args(false);
}

}  // namespace

CommandLine command_line(int argc, char** argv, const std::string& version_text) {
  Arguments a;
  CLI::App app{"Treejet: electrospinning jets as chains of charged viscoelastic beads", "treejet"};
  app.set_version_flag("--version", version_text);
  app.require_subcommand(1);
  app.footer(lesson);

  auto& run = *app.add_subcommand("run", "Run a deck: statdat.dat, traj.xyz and a table on the terminal");
  add_deck(run, a);
  run.add_option("--out", a.out, "directory of the results, made if missing")->capture_default_str();
  run.add_option("--threads", a.threads, "threads at the most; small jets use fewer (default: all cores)")
      ->check(CLI::Range(1, 4096));
  run.add_flag("--quiet", a.quiet, "no table, no progress, no summary");
  run.add_flag("--force", a.force, "replace results that are there already");

  auto& check = *app.add_subcommand("check", "Read a deck and tell what it composes and leaves out, and why");
  add_deck(check, a);
  app.add_subcommand("template", "Print a commented deck with every directive");
  app.add_subcommand("reference", "Print the tables of directives and observables (Markdown)");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    constexpr int wrong_arguments = 2;
    return {std::nullopt, app.exit(e) == 0 ? 0 : wrong_arguments};
  }
  a.command = app.get_subcommands().front()->get_name();
  return {a, 0};
}

}  // namespace treejet
