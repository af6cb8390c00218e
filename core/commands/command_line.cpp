#include "core/commands/command_line.hpp"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/number.hpp"
#include "core/commands/companions.hpp"
#include "core/io/frame_writer.hpp"

namespace treejet {

namespace {

constexpr const char* lesson = R"(
A deck is a text file of directives in CGS units, as JETSPIN's input.dat. Start from a working one:
  treejet template > input.dat         a commented deck with every directive
  treejet check input.dat              what it composes, without running it
  treejet run input.dat --out results  run it; then look at it:
  treejet plot results                 pictures of the jet and of the table
  treejet view results                 the jet in a browser, to turn and to play (wants print hdf5 in the deck)
Any directive can be replaced for one run:
  treejet run input.dat --out r12 --set "external potential 40.03" --set "final time 0.1"

A run is stopped with a checkpoint by Ctrl-C, SIGTERM, SIGUSR1, SIGHUP or --walltime, and goes on to the same bytes:
  treejet run --resume results

Exit codes: 0 done, 2 deck or arguments, 3 numerical failure, 4 files, 5 memory refused, 75 stopped with a checkpoint.)";

CLI::Option* add_deck(CLI::App& command, Arguments& a) {
  auto* deck = command.add_option("DECK", a.deck, "the deck, e.g. examples/pvp/input.dat");
  command
      .add_option("--set", a.overrides,
                  "a directive with its value that replaces the deck's, e.g. "
                  "--set \"final time 0.1\" or --set \"external potential = 10 kV\"; may be repeated")
      ->allow_extra_args(false)
      ->needs(deck);
  return deck;
}

/// Seconds, or hours, minutes and seconds as batch systems write them.
std::optional<double> wall_seconds(const std::string& text) {
  int hours = 0, minutes = 0, end = 0;
  double seconds = 0;
  const auto all = static_cast<int>(text.size());
  constexpr const char* digits = "0123456789:.";
  if (text.find_first_not_of(digits) != std::string::npos) return std::nullopt;
  if (std::sscanf(text.c_str(), "%d:%2d:%lf%n", &hours, &minutes, &seconds, &end) < 3 || end != all) {
    hours = minutes = 0;
    if (std::sscanf(text.c_str(), "%lf%n", &seconds, &end) < 1 || end != all) return std::nullopt;
  } else if (minutes >= 60 || !(seconds < 60)) {
    return std::nullopt;
  }
  const double sum = 3600.0 * hours + 60 * minutes + seconds;
  return sum > 0 ? std::optional(sum) : std::nullopt;
}

void add_threads(CLI::App& command, Arguments& a) {
  const auto number = [](std::string& text) {
    if (text != "auto") return CLI::Range(1, 4096)(text);
    text = "0";
    return std::string();
  };
  command
      .add_option(
          "--threads", a.threads,
          "threads at the most, of each rank; small jets use fewer (auto: OMP_NUM_THREADS, or all cores "
          "there are for it)")
      ->transform(CLI::Validator(number, "1 to 4096, or auto"))
      ->default_str("auto");
}

/// Numbers are written in options as they are in decks: 1d-5, +3.
template <class T>
CLI::Validator written_as_in_decks(Reading<T> (*reading_of)(std::string_view)) {
  return CLI::Validator(
      [reading_of](std::string& text) {
        const Reading<T> reading = reading_of(text);
        if (reading.problem.empty()) text = fmt::format("{}", reading.value);
        return reading.problem.empty() ? "" : "expected a number, " + reading.problem;
      },
      "");
}

template <class T>
void add_choice(CLI::App& command, const char* name, T& value, std::map<std::string, T> words,
                const char* meaning) {
  command.add_option(name, value, meaning)->transform(CLI::CheckedTransformer(std::move(words)));
}

void add_field(CLI::App& app, Arguments& a) {
  auto& field = *app.add_subcommand("field", "Coulomb field of the charges in a table, at the charges");
  CoulombSetting& c = a.coulomb;
  field.add_option("POINTS", a.points, "CSV with a header line and columns x, y, z, q")->required();
  add_choice<CoulombSum>(
      field, "--coulomb", c.coulomb,
      {{"direct", CoulombSum::direct}, {"tree", CoulombSum::tree}, {"auto", CoulombSum::automatic}},
      "how to sum");
  field.add_option("--accuracy", c.coulomb_accuracy, "relative L2 error of the field")
      ->transform(written_as_in_decks(real_number))
      ->capture_default_str();
  add_threads(field, a);
  field.add_option("--repeat", a.repeat, "evaluate so often, report the best time")
      ->check(CLI::Range(1, 1000000));
  field.add_flag("--compare", a.compare, "measure the error against direct summation");
  field.add_option("--out", a.field_out, "write x,y,z,q,ex,ey,ez to this file");
  field.add_flag("--json", a.json, "one JSON object instead of text");
  field.add_option("--order", c.coulomb_order, "pin the order of the expansions")
      ->transform(written_as_in_decks(integer));
  field.add_option("--opening", c.coulomb_opening, "pin the opening")
      ->transform(written_as_in_decks(real_number));
  field.add_option("--leaf", c.coulomb_leaf, "pin the points of a leaf")
      ->transform(written_as_in_decks(integer));
  add_choice<TreeOrder>(
      field, "--tree", c.coulomb_tree,
      {{"auto", TreeOrder::automatic}, {"chain", TreeOrder::chain}, {"space", TreeOrder::space}},
      "order of the points in the tree");
  add_choice<ExpansionKind>(field, "--expansions", c.coulomb_expansions,
                            {{"local", ExpansionKind::local}, {"none", ExpansionKind::none}},
                            "local: dual tree; none: Barnes and Hut's");
}

void add_files(CLI::App& app, Arguments& a) {
  auto& convert = *app.add_subcommand("convert", "Write a traj.h5 in the format of another tool");
  convert.add_option("FILE", a.file, "traj.h5 of a run")->required();
  std::vector<std::string> names, meanings;
  for (const FrameFormat& f : frame_formats) {
    names.emplace_back(f.name);
    meanings.push_back(fmt::format("{} ({})", f.name, f.readers));
  }
  convert.add_option("--to", a.format, fmt::format("{}", fmt::join(meanings, ", ")))
      ->required()
      ->check(CLI::IsMember(names));
  convert.add_option("--out", a.converted,
                     "the file (default: beside FILE, with the extension of the format)");
  convert.add_flag("--force", a.force, "replace files that are there already");
  auto& info = *app.add_subcommand("info", "Tell what a file of a run contains and what made it");
  info.add_option("FILE", a.file, "traj.h5, statdat.dat, traj.xyz, run.json, ...")->required();
}

}  // namespace

std::string for_shell(const std::string& text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::optional<Arguments> command_line(int argc, char** argv, const std::string& version_text) {
  Arguments a;
  CLI::App app{"Treejet: electrospinning jets as chains of charged viscoelastic beads", "treejet"};
  app.set_version_flag("--version", version_text);
  app.require_subcommand(1);
  app.footer(lesson);

  auto& run = *app.add_subcommand("run", "Run a deck: statdat.dat, traj.xyz and a table on the terminal");
  auto* deck = add_deck(run, a);
  auto* out =
      run.add_option("--out", a.out, "directory of the results, made if missing")
          ->check(CLI::Validator(
              [](const std::string& name) { return name.empty() ? "expected a name, found nothing" : ""; },
              ""))
          ->capture_default_str();
  add_threads(run, a);
  run.add_flag("--quiet", a.quiet, "no table, no progress, no summary");
  auto* force = run.add_flag("--force", a.force, "replace results that are there already");
  auto* resume =
      run.add_option("--resume", a.resume, "continue the run stopped in this directory; its deck is known");
  resume->excludes(out)->excludes(force);
  run.callback([deck, resume] {
    if (deck->empty() && resume->empty()) throw CLI::RequiredError("DECK");
  });
  run.add_flag("--estimate-error", a.estimate_error,
               "run once more at a tenth of the tolerance: statdat.error.dat, errors of all rows and means");
  run.add_option_function<std::string>(
         "--walltime", [&a](const std::string& text) { a.walltime = wall_seconds(text); },
         "stop with a checkpoint before this much time has passed: seconds or hh:mm:ss")
      ->check(
          [](const std::string& text) { return wall_seconds(text) ? "" : "expected seconds or hh:mm:ss"; });

  auto& check = *app.add_subcommand("check", "Read a deck and tell what it composes and leaves out, and why");
  add_deck(check, a)->required();
  check.add_flag("--json", a.json, "one JSON object instead of text: notes, laboratory sheet, plan");
  add_files(app, a);
  add_field(app, a);
  app.add_subcommand("template", "Print a commented deck with every directive");
  app.add_subcommand("reference", "Print the tables of directives and observables (Markdown)");
  for (const Companion& c : companions) app.add_subcommand(c.word, c.what);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream wrong;
    if (app.exit(e, std::cout, wrong) == 0) return std::nullopt;
    throw InputError(wrong.str().substr(0, wrong.str().find_last_not_of('\n') + 1));
  }
  a.command = app.get_subcommands().front()->get_name();
  return a;
}

}  // namespace treejet
