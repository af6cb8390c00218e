/// The paper's performance section: speedup S_p = T_s / T_p and efficiency S_p / n_p of case 3 at several
/// sizes, T_s being the best time of the serial program.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "validation/machine.hpp"
#include "validation/scaling_run.hpp"
#include "validation/studies.hpp"
#include "validation/team.hpp"

namespace treejet {

namespace {

struct Size {
  int refinement;
  bool tree;
  int evaluations;
};

Measurement measured(const Team& team, const Size& size, int cores) {
  return measurement(
      output(team, cores,
             fmt::format("scaling-run --refinement {} --threads {} --evaluations {}{}", size.refinement,
                         team.threads, size.evaluations, size.tree ? " --tree" : "")));
}

std::string kind(const Team& t) {
  return t.serial() ? "serial" : t.threads == 1 ? "ranks" : t.ranks == 1 ? "threads" : "mixed";
}

struct Sample {
  std::vector<Measurement> runs;  ///< by ascending time

  const Measurement& median() const { return runs[(runs.size() - 1) / 2]; }
  double least() const { return runs.front().seconds; }
  double most() const { return runs.back().seconds; }
};

/// All teams by turns, so that a slow moment of the machine hits all of them.
std::vector<Sample> samples(const std::vector<Team>& teams, const Size& size, int cores, int repeats) {
  std::vector<Sample> all(teams.size());
  for (int turn = 0; turn < repeats; ++turn)
    for (std::size_t k = 0; k < teams.size(); ++k)
      if (turn == 0 || teams[k].workers() <= cores) all[k].runs.push_back(measured(teams[k], size, cores));
  for (Sample& s : all)
    std::sort(s.runs.begin(), s.runs.end(), [](auto& a, auto& b) { return a.seconds < b.seconds; });
  return all;
}

std::vector<Team> teams(int most) {
  std::vector<Team> all = {{1, 1}};
  for (int p = 2; p <= most; p *= 2)
    for (int threads = 1; threads <= p; threads *= 2)
      if (threads == p || !mpi_launcher().empty()) all.push_back({p / threads, threads});
  return all;
}

/// The smallest share of beads from which on every larger one has an efficiency above 0.8.
class SmallestShare {
 public:
  void add(const std::string& kind, double beads_per_worker, double efficiency) {
    auto& known = efficiencies_[kind];
    auto& least = known.try_emplace(beads_per_worker, efficiency).first->second;
    least = std::min(least, efficiency);
  }
  void print() const {
    for (const auto& [kind, known] : efficiencies_) {
      double smallest = 0;
      for (auto at = known.rbegin(); at != known.rend() && at->second > enough; ++at) smallest = at->first;
      if (smallest > 0)
        fmt::print("{}: efficiency above {} from {:.0f} beads a worker on (the paper: 50)\n", kind, enough,
                   smallest);
      else
        fmt::print("{}: no size has an efficiency above {}\n", kind, enough);
    }
  }

 private:
  static constexpr double enough = 0.8;
  std::map<std::string, std::map<double, double>> efficiencies_;
};

}  // namespace

void study_scaling(Report& report) {
  report.section({"Speedup and efficiency",
                  "The paper's two figures: case 3 at several sizes on ranks, threads and both, each worker "
                  "on a core of its own; more workers than cores show correctness only.",
                  "treejet-validate scaling --out DIR"});
  const int cores = physical_cores();
  const std::vector<Size> sizes =
      report.quick ? std::vector<Size>{{1, false, 200}, {8, true, 10}}
                   : std::vector<Size>{{1, false, 4000}, {2, false, 2000}, {4, false, 1000}, {8, false, 400},
                                       {22, false, 100}, {75, true, 130},  {750, true, 70}};
  const int repeats = report.quick ? 1 : 5;
  const std::vector<Team> all_teams = teams(2 * cores);
  fmt::print("{}, {} physical cores; {}\n", processor_name(), cores,
             mpi_launcher().empty() ? "no MPI: threads only" : mpi_launcher());

  auto table = report.table(
      "scaling", "Time of an evaluation, case 3 by its own scheme, every term at every stage",
      {"beads", "sum", "workers", "kind", "ranks", "threads", "median [us]", "least [us]", "most [us]",
       "speedup", "efficiency", "compute [us]", "exchange [us]", "wait [us]", "cores"});
  const ProcessorUse processors;
  SmallestShare direct, tree;
  int done = 0, different = 0;
  for (const Size& size : sizes) {
    report.progress("scaling", done++, static_cast<int>(sizes.size()));
    const std::vector<Sample> times = samples(all_teams, size, cores, repeats);
    for (std::size_t k = 0; k < all_teams.size(); ++k) {
      const Team& team = all_teams[k];
      const Measurement& m = times[k].median();
      different += m.bits != times[0].median().bits;
      const bool timed = team.workers() <= cores;
      const auto us = [&](double seconds) { return timed ? Cell(1e6 * seconds) : Cell(std::nan("")); };
      const double speedup = times[0].least() / m.seconds, efficiency = speedup / team.workers();
      table.row({std::int64_t{m.beads}, std::string(size.tree ? "tree" : "direct"),
                 std::int64_t{team.workers()}, timed ? kind(team) : kind(team) + ", correctness only",
                 std::int64_t{team.ranks}, std::int64_t{team.threads}, us(m.seconds), us(times[k].least()),
                 us(times[k].most()), timed ? Cell(speedup) : Cell(std::nan("")),
                 timed ? Cell(efficiency) : Cell(std::nan("")), us(m.seconds - m.exchange - m.wait),
                 us(m.exchange), us(m.wait), m.cores});
      if (timed && !team.serial())
        (size.tree ? tree : direct).add(kind(team), double(m.beads) / team.workers(), efficiency);
    }
  }
  fmt::print("\ndirect sum\n");
  direct.print();
  fmt::print("tree\n");
  tree.print();
  fmt::print("\nothers took {:.0f} % of the processors' time meanwhile{}\n", 100 * processors.by_others(),
             processors.by_others() > 0.05 ? ": these speedups are no measure of the program" : "");
  report.check("teams of workers whose last slopes differ from the serial program's in any bit", different, 0,
               0);
}

}  // namespace treejet
