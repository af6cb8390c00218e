#include "core/commands/command_line.hpp"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/number.hpp"
#include "core/commands/companions.hpp"
#include "core/commands/manual.hpp"
#include "core/deck/suggestion.hpp"
#include "core/deck/units.hpp"
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

A run is stopped with a checkpoint by Ctrl-C, SIGTERM, SIGUSR1, SIGHUP or --walltime, and goes on to the same bytes;
at its end it goes on to a later one; and another deck begins with its jet:
  treejet run --resume results
  treejet run --resume results --set "final time 1.0"
  treejet run other.dat --from results --out r2

Exit codes: 0 done, 2 deck or arguments, 3 numerical failure, 4 files, 5 memory refused, 75 stopped with a checkpoint.)";

CLI::Option* add_deck(CLI::App& command, Arguments& a) {
  auto* deck = command.add_option("DECK", a.deck, "the deck, e.g. examples/pvp/input.dat")->option_text(" ");
  command
      .add_option("--set", a.overrides,
                  "a directive with its value that replaces the deck's, e.g. "
                  "--set \"final time 0.1\" or --set \"external potential = 10 kV\"; may be repeated")
      ->allow_extra_args(false)
      ->option_text("\"DIRECTIVE VALUE\"");
  return deck;
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
      ->transform(CLI::Validator(number, ""))
      ->option_text("N|auto");
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
  std::vector<std::string> names;
  for (const auto& [word, value] : words) names.push_back(word);
  command.add_option(name, value, meaning)
      ->transform(CLI::CheckedTransformer(std::move(words)))
      ->option_text(fmt::format("{}", fmt::join(names, "|")));
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
  field.add_flag("--force", a.force, "replace a file that is there already");
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

/// Whole numbers with colons between them; none if there is anything else.
std::vector<int> between_colons(std::string_view text) {
  std::vector<int> fields;
  while (true) {
    const std::string_view field = text.substr(0, text.find(':'));
    const Reading<int> number = integer(field);
    if (!number.problem.empty() || field.find_first_not_of("0123456789") != std::string_view::npos) return {};
    fields.push_back(number.value);
    if (field.size() == text.size()) return fields;
    text.remove_prefix(field.size() + 1);
  }
}

std::optional<double> seconds_with_unit(std::string_view text) {
  const std::size_t length = number_length(text);
  const Reading<double> number = real_number(text.substr(0, length));
  const auto second = unit("s"), given = length < text.size() ? unit(text.substr(length)) : second;
  if (!number.problem.empty() || !given || given->dimension != second->dimension || !(number.value > 0))
    return std::nullopt;
  return converted(number.value, *given, *second);
}

std::vector<CommandHelp> commands_of(const CLI::App& app) {
  std::vector<CommandHelp> all;
  for (const CLI::App* command : app.get_subcommands({})) {
    CommandHelp help{command->get_name(), command->get_description(), {}};
    for (const CLI::Option* o : command->get_options())
      if (o->get_name() != "--help")
        help.options.push_back({o->get_name(), o->get_option_text(), o->get_description()});
    for (const Companion& c : companions)
      if (c.word == help.name) help.options.push_back({"--help", "", "tells its options"});
    all.push_back(std::move(help));
  }
  return all;
}

/// Words of a command line that no parser of options can make sense of.
void expect_sensible(const std::vector<std::string>& words, const CLI::App& app) {
  if (!words.empty() && !words[0].starts_with('-')) {
    std::vector<std::string> commands;
    for (const auto* command : app.get_subcommands({})) commands.push_back(command->get_name());
    if (std::find(commands.begin(), commands.end(), words[0]) == commands.end()) {
      const std::string_view meant = nearest(words[0], commands);
      throw InputError(fmt::format("{}: no such command; {}", quoted(std::string_view(words[0])),
                                   meant.empty() ? fmt::format("there are {}", fmt::join(commands, ", "))
                                                 : fmt::format("did you mean {}?", meant)));
    }
  }
  for (std::size_t i = 0; i + 2 < words.size(); ++i) {
    if (words[i] != "--set" || words[i + 1].find_first_of(" \t=") != std::string::npos) continue;
    std::string line = words[i + 1];
    for (std::size_t k = i + 2; k < words.size() && !words[k].starts_with("--"); ++k) line += ' ' + words[k];
    throw InputError(
        fmt::format("--set {}: quote a directive with its value: --set \"{}\"", words[i + 1], line));
  }
}

}  // namespace

std::optional<double> wall_seconds(const std::string& text) {
  const std::size_t dash = text.find('-');
  const bool with_days = dash != std::string::npos;
  std::vector<int> fields = between_colons(std::string_view(text).substr(with_days ? dash + 1 : 0));
  if (!with_days && fields.size() <= 1) return seconds_with_unit(text);
  const std::vector<int> days =
      with_days ? between_colons(std::string_view(text).substr(0, dash)) : std::vector{0};
  if (days.size() != 1 || fields.empty() || fields.size() > 3) return std::nullopt;
  if (with_days)
    fields.resize(3);  // hours first
  else if (fields.size() == 2)
    fields.insert(fields.begin(), 0);  // minutes first
  const bool led_by_hours = fields[0] > 0 || with_days;
  if (fields[2] >= 60 || (led_by_hours && fields[1] >= 60) || (with_days && fields[0] >= 24))
    return std::nullopt;
  const double sum = 86400.0 * days[0] + 3600.0 * fields[0] + 60.0 * fields[1] + fields[2];
  return sum > 0 ? std::optional(sum) : std::nullopt;
}

std::optional<Arguments> command_line(int argc, char** argv, const std::string& version_text) {
  Arguments a;
  CLI::App app{"Treejet: electrospinning jets as chains of charged viscoelastic beads", "treejet"};
  app.set_version_flag("--version", version_text);
  app.require_subcommand(1);

  auto& run = *app.add_subcommand("run", "Run a deck: statdat.dat, traj.xyz and a table on the terminal");
  auto* deck = add_deck(run, a);
  auto* out =
      run.add_option("--out", a.out, "directory of the results, made if missing (default: this one)")
          ->option_text("DIR")
          ->check(CLI::Validator(
              [](const std::string& name) { return name.empty() ? "expected a name, found nothing" : ""; },
              ""));
  add_threads(run, a);
  run.add_flag("--quiet", a.quiet, "no table, no progress, no summary");
  auto* force = run.add_flag("--force", a.force, "replace results that are there already");
  auto* resume =
      run.add_option(
             "--resume", a.resume,
             "go on with the run in this directory, whose deck is known; --set \"final time ...\" takes it "
             "beyond its end")
          ->option_text("DIR");
  auto* from =
      run.add_option("--from", a.from,
                     "begin with the jet of another run: its last state, or DIR@t (s, or a unit: @12ms) its "
                     "frame at that time. All may differ but system and the columns of the beads")
          ->option_text("DIR[@t]");
  resume->excludes(out)->excludes(force)->excludes(from);
  run.callback([deck, resume] {
    if (deck->empty() && resume->empty()) throw CLI::RequiredError("DECK, or --resume DIR,");
  });
  run.add_flag("--estimate-error", a.estimate_error,
               "run once more at a tenth of the tolerance: statdat.error.dat, errors of all rows and means");
  run.add_option_function<std::string>(
         "--walltime", [&a](const std::string& text) { a.walltime = wall_seconds(text); },
         "stop with a checkpoint before this much time has passed: d-hh:mm:ss, hh:mm:ss, mm:ss as Slurm "
         "writes "
         "them, or a number of s, min, h (1800, 30min)")
      ->option_text("TIME")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return wall_seconds(text) ? "" : "expected d-hh:mm:ss, hh:mm:ss, mm:ss, 1800 (s), 30min or 2h";
          },
          ""));

  auto& check = *app.add_subcommand("check", "Read a deck and tell what it composes and leaves out, and why");
  add_deck(check, a)->required();
  check.add_flag("--json", a.json, "one JSON object instead of text: notes, laboratory sheet, plan");
  add_files(app, a);
  add_field(app, a);
  app.add_subcommand("template", "Print a commented deck with every directive");
  auto& reference =
      *app.add_subcommand("reference", "Print the tables of directives and observables (Markdown)");
  std::string form = "markdown";
  reference
      .add_option("--as", form,
                  "manual pages, of the program and of decks, or completion for bash, instead of tables")
      ->check(CLI::IsMember({"markdown", "man1", "man5", "bash"}))
      ->option_text("man1|man5|bash");
  for (const Companion& c : companions) app.add_subcommand(c.word, c.what);

  app.footer(lesson);  // of this help, not of those of the commands

  expect_sensible({argv + 1, argv + argc}, app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream wrong;
    if (app.exit(e, std::cout, wrong) == 0) return std::nullopt;
    throw InputError(wrong.str().substr(0, wrong.str().find_last_not_of('\n') + 1));
  }
  a.command = app.get_subcommands().front()->get_name();
  if (form == "man1") a.reference = program_manual(commands_of(app), lesson);
  if (form == "man5") a.reference = deck_manual();
  if (form == "bash") a.reference = bash_completion(commands_of(app));
  return a;
}

}  // namespace treejet
