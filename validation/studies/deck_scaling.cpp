/// Speedup and efficiency of any deck on teams of workers, and where their time goes: a table for a paper.
///
/// All teams run by turns, the same number of steps from the same beginning, and a speedup is the median over
/// the turns of the ratio of two times of one turn: a processor that is now fast, now slow is so for both.
/// More workers than cores show that the answer is right, and nothing of speed. Where teams are asked for by
/// their workers, as many copies of the serial program run by turns with them, too: what these lose to each
/// other (clock, caches, memory) no team can gain.

#include "validation/support/deck_scaling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <map>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/version.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "validation/support/deck_run.hpp"
#include "validation/support/machine.hpp"
#include "validation/support/spread.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;

std::string arguments(const DeckScaling& asked, const Workers& team, std::int64_t steps,
                      const fs::path& files) {
  std::string line = fmt::format("deck-run {} --threads {} --out {}", for_shell(asked.deck),
                                 team.layout.threads, for_shell(files.string()));
  for (const std::string& o : asked.overrides) line += fmt::format(" --set {}", for_shell(o));
  if (!asked.from.empty()) line += fmt::format(" --from {}", for_shell(asked.from));
  line += steps > 0 ? fmt::format(" --steps {}", steps) : fmt::format(" --seconds {}", asked.seconds);
  return line + (team.subdomains ? " --subdomains" : "");
}

/// The turns of one team.
struct Turns {
  Workers team;
  bool timed;
  std::vector<DeckMeasurement> turns = {};

  std::vector<double> seconds() const {
    std::vector<double> t;
    for (const DeckMeasurement& m : turns) t.push_back(m.seconds / double(m.evaluations));
    return t;
  }
  /// The turn of median time.
  const DeckMeasurement& median() const {
    const std::vector<double> t = seconds();
    const auto at = std::find(t.begin(), t.end(), Spread(t).median);
    return turns[static_cast<std::size_t>(at - t.begin())];
  }
  Spread speedup(const Turns& serial) const {
    const std::vector<double> those = serial.seconds();
    std::vector<double> ratios = seconds();
    for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] = those[k] / ratios[k];
    return Spread(ratios);
  }
};

/// Of serial programs at the same time, each on a core of its own; their evaluations count together.
DeckMeasurement of_copies(int count, const DeckScaling& asked, std::int64_t steps, const fs::path& files) {
  std::vector<std::future<std::string>> copies;
  for (const int core : cores_apart()) {
    if (std::ssize(copies) == count) break;
    const std::string line = arguments(asked, {{1, 1}}, steps, files / std::to_string(core));
    copies.push_back(std::async(std::launch::async, output_on_core, core, line));
  }
  std::vector<DeckMeasurement> all;
  for (auto& copy : copies) all.push_back(deck_measurement(copy.get()));
  DeckMeasurement m = all.front();
  for (std::size_t k = 1; k < all.size(); ++k) {
    m.seconds += all[k].seconds;
    for (std::size_t w = 0; w < m.work.size(); ++w) m.work[w] += all[k].work[w];
    m.cores += "," + all[k].cores;
  }
  const double each = double(count) * count;  // the mean, of as many evaluations as there are programs
  m.seconds /= each;
  for (double& seconds : m.work) seconds /= each;
  return m;
}

std::vector<Turns> measured(const DeckScaling& asked, const std::vector<Workers>& teams, int cores,
                            Report& report) {
  std::vector<Turns> all;
  for (const Workers& team : teams) all.push_back({team, team.layout.workers() <= cores});
  std::int64_t steps = asked.steps;
  int done = 0;
  for (int turn = 0; turn < asked.turns; ++turn)
    for (Turns& t : all) {
      report.progress("scaling", done++, asked.turns * static_cast<int>(all.size()));
      if (turn > 0 && !t.timed) continue;
      const fs::path files = report.directory() / "deck-run";
      t.turns.push_back(t.team.copies ? of_copies(t.team.layout.workers(), asked, steps, files)
                                      : deck_measurement(output(t.team.layout, cores,
                                                                arguments(asked, t.team, steps, files))));
      fs::remove_all(files);
      steps = all.front().turns.front().steps;  // as many for all
    }
  return all;
}

/// What is told of a team, by the name of its column; NaN where there is nothing to tell.
using Row = std::map<std::string, double>;

Row row(const Turns& of, const Turns& serial) {
  const DeckMeasurement& m = of.median();
  const double us = 1e6 / double(m.evaluations);
  const Spread speedup = of.speedup(serial), time(of.seconds());
  Row r = {{"evaluation [us]", us * m.seconds},
           {"least [us]", 1e6 * time.least},
           {"most [us]", 1e6 * time.most},
           {"speedup", speedup.median},
           {"least speedup", speedup.least},
           {"most speedup", speedup.most},
           {"efficiency", speedup.median / of.team.layout.workers()},
           {"busiest", us * m.busiest},
           {"checkpoint [s]", m.checkpoint}};
  for (std::size_t k = 0; k < m.work.size(); ++k) r[std::string(work_names[k]) + " [us]"] = us * m.work[k];
  if (!of.timed)
    for (auto& [name, value] : r) value = std::nan("");
  r["memory [MB]"] = m.memory / 1e6;
  return r;
}

const std::vector<std::string>& columns() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = {"evaluation [us]", "least [us]", "most [us]"};
    for (const char* work : work_names) names.push_back(std::string(work) + " [us]");
    for (const char* name :
         {"speedup", "least speedup", "most speedup", "efficiency", "checkpoint [s]", "memory [MB]"})
      names.emplace_back(name);
    return names;
  }();
  return all;
}

std::string kind(const Turns& of) {
  return of.timed ? of.team.name() : of.team.name() + " (correctness only)";
}

void write_table(const std::vector<Turns>& all, Report& report) {
  std::vector<std::string> names = {"workers", "kind", "ranks", "threads", "beads", "steps", "evaluations"};
  names.insert(names.end(), columns().begin(), columns().end());
  names.emplace_back("cores");
  names.emplace_back("Coulomb sum");
  auto table = report.table("scaling_deck", "Time of an evaluation, and where it goes", names);
  for (const Turns& of : all) {
    const RankLayout& layout = of.team.layout;
    const DeckMeasurement& m = of.median();
    std::vector<Cell> cells = {std::int64_t{layout.workers()},
                               kind(of),
                               std::int64_t{layout.ranks},
                               std::int64_t{layout.threads},
                               m.beads,
                               m.steps,
                               m.evaluations};
    const Row r = row(of, all.front());
    for (const std::string& name : columns()) cells.push_back(r.at(name));
    cells.push_back(m.cores);
    cells.push_back(m.sum);
    table.row(cells);
  }
}

/// Three digits, as a paper prints them.
std::string digits(double value) {
  if (std::isnan(value)) return "-";
  if (value == 0) return "0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fmt::format("{:.{}f}", value, std::clamp(2 - before, 0, 3));
}

/// The narrow table, in Markdown, which is also plain text.
void write_text(const DeckScaling& asked, const std::vector<Turns>& all, int cores, double by_others,
                const fs::path& file) {
  const DeckMeasurement& serial = all.front().median();
  const Version v = version();
  std::string text = fmt::format(
      "{} {}, {} beads, {} steps of {} evaluations; Coulomb sum: {}.\n{}, {} cores; treejet {} (git {}), {}; "
      "median of {} turns, others took {:.0f} % of the processors.\nTimes in us an evaluation, mean over the "
      "ranks; memory is the most of any rank's process.\n\n",
      asked.deck, asked.from.empty() ? "from its beginning" : "from " + asked.from, serial.beads,
      serial.steps, serial.evaluations, serial.sum, processor_name(), cores, v.number, v.commit, v.compiler,
      asked.turns, 100 * by_others);
  std::vector<std::string> shown = {"evaluation [us]"};
  for (const char* work : work_names) shown.push_back(std::string(work) + " [us]");
  for (const char* name : {"speedup", "efficiency", "memory [MB]"}) shown.emplace_back(name);
  std::string head = "| workers | kind | ranks x threads |", line = "|---:|---|---|";
  for (const std::string& name : shown) {
    head += fmt::format(" {} |", name.ends_with(" [us]") ? name.substr(0, name.size() - 5) : name);
    line += "---:|";
  }
  text += head + "\n" + line + "\n";
  for (const Turns& of : all) {
    const RankLayout& layout = of.team.layout;
    text += fmt::format("| {} | {} | {} x {} |", layout.workers(), kind(of), layout.ranks, layout.threads);
    const Row r = row(of, all.front());
    for (const std::string& name : shown) text += fmt::format(" {} |", digits(r.at(name)));
    text += "\n";
  }
  for (const Turns& of : all)  // it chooses among fewer shapes: a speedup has that in it
    if (const std::string& sum = of.median().sum; sum != serial.sum)
      text += fmt::format("\n{} {} x {}: Coulomb sum by {}.\n", of.team.name(), of.team.layout.ranks,
                          of.team.layout.threads, sum);
  std::ofstream out(file);
  out << text;
  if (!out) throw FileError(file.string() + ": cannot be written");
  fmt::print("\n{}\n{}: for a paper\n", text, file.string());
}

void judge(const DeckScaling& asked, const std::vector<Turns>& all, Report& report) {
  const DeckMeasurement& serial = all.front().median();
  int different = 0;
  double apart = 0;
  bool compared = false;
  for (const Turns& of : all) {
    const DeckMeasurement& m = of.median();
    if (!of.team.subdomains) {
      different += m.bits != serial.bits;
    } else if (m.t == serial.t) {
      compared = true;
      apart = std::max(apart, std::abs(m.x - serial.x) / serial.x);
    }
  }
  report.check("teams with replicated data whose last state differs from the serial program's in any bit",
               different, 0, 0);
  if (std::none_of(all.begin(), all.end(), [](const Turns& t) { return t.team.subdomains; })) return;
  const std::string claim = "place of the oldest bead with distributed data against the serial program's";
  if (!compared)
    return report.not_judged(claim, "adaptive steps differ in length where the field does in a late digit");
  // a force that errs by so much moves no bead by more of its way
  const Parameters p = read_deck(asked.deck, asked.overrides).parameters;
  report.check(claim, apart, 0, std::max(p.coulomb_accuracy, p.tolerance.value_or(0)));
}

}  // namespace

void study_scaling_of(const DeckScaling& asked, Report& report) {
  report.section({"Speedup and efficiency of a deck",
                  fmt::format("{} on teams of workers: each on a core of its own; more workers than cores "
                              "show correctness only. Ranks hold the whole jet each (replicated) or a "
                              "subdomain of it (distributed). Copies are serial programs at the same time: "
                              "what they lose to each other no team can gain.",
                              asked.deck),
                  fmt::format("treejet-validate scaling --deck {} --out DIR", for_shell(asked.deck))});
  const int cores = physical_cores();
  fmt::print("{}, {} physical cores; {}\n", processor_name(), cores,
             mpi_launcher().empty() ? "no MPI: threads only" : mpi_launcher());
  const std::string why_whole = undistributable(asked);
  if (!why_whole.empty()) fmt::print("without parallel distributed: {}\n", why_whole);
  const std::vector<Workers> all_teams = teams(asked, cores, why_whole.empty());
  const ProcessorUse processors;
  const std::vector<Turns> all = measured(asked, all_teams, cores, report);
  const double by_others = processors.by_others();
  write_table(all, report);
  write_text(asked, all, cores, by_others, report.directory() / "scaling_deck.md");
  if (by_others > 0.05)
    fmt::print("others took {:.0f} % of the processors' time: these speedups are no measure of the program\n",
               100 * by_others);
  judge(asked, all, report);
}

}  // namespace treejet
