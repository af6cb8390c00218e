/// The paper's performance section: speedup S_p = T_s / T_p and efficiency S_p / n_p of case 3 at several
/// sizes, T_s being the time of the serial program, which needs no team.
///
/// All ways run by turns, and a speedup is the median over the turns of the ratio of two times of one turn:
/// a processor that is now fast, now slow, as those of shared machines are, is so for both.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "validation/support/machine.hpp"
#include "validation/support/rank_layout.hpp"
#include "validation/support/scaling_run.hpp"
#include "validation/support/spread.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

struct Size {
  int refinement;
  bool tree;
  int evaluations;
};

/// A team, and whether its ranks hold a subdomain of the chain each or all of it.
struct Way {
  RankLayout layout;
  bool subdomains = false;

  std::string name() const {
    if (layout.serial()) return "serial";
    if (subdomains) return "ranks with subdomains";
    return layout.threads == 1 ? "ranks" : layout.ranks == 1 ? "threads" : "mixed";
  }
};

Measurement measured(const Way& way, const Size& size, int cores) {
  return measurement(output(way.layout, cores,
                            fmt::format("scaling-run --refinement {} --threads {} --evaluations {}{}{}",
                                        size.refinement, way.layout.threads, size.evaluations,
                                        size.tree ? " --tree" : "", way.subdomains ? " --subdomains" : "")));
}

/// The turns of one way.
struct Sample {
  std::vector<Measurement> turns;

  std::vector<double> seconds() const {
    std::vector<double> t;
    for (const Measurement& m : turns) t.push_back(m.seconds);
    return t;
  }
  /// The turn of median time.
  Measurement median() const {
    std::vector<Measurement> by_time = turns;
    std::sort(by_time.begin(), by_time.end(), [](auto& a, auto& b) { return a.seconds < b.seconds; });
    return by_time[(by_time.size() - 1) / 2];
  }
};

/// T_s / T_p, turn by turn.
std::vector<double> speedups(const Sample& serial, const Sample& layout) {
  std::vector<double> ratios;
  for (std::size_t turn = 0; turn < layout.turns.size(); ++turn)
    ratios.push_back(serial.turns[turn].seconds / layout.turns[turn].seconds);
  return ratios;
}

std::vector<Sample> samples(const std::vector<Way>& ways, const Size& size, int cores, int repeats) {
  std::vector<Sample> all(ways.size());
  for (int turn = 0; turn < repeats; ++turn)
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (turn == 0 || ways[k].layout.workers() <= cores)
        all[k].turns.push_back(measured(ways[k], size, cores));
  return all;
}

/// The serial program first, and more workers than cores, whose bits can be compared. Subdomains, whose bits
/// depend on their number, go with the tree only.
std::vector<Way> ways(int cores, bool tree) {
  std::vector<Way> all = {{{1, 1}}};
  for (int p = 2; p <= 2 * cores; p *= 2) {
    for (int threads = 1; threads <= p; threads *= 2)
      if (threads == p || !mpi_launcher().empty()) all.push_back({{p / threads, threads}});
    if (tree && p <= cores && !mpi_launcher().empty()) all.push_back({{p, 1}, /*subdomains*/ true});
  }
  return all;
}

/// A row of the table; without times if there are not so many cores.
std::vector<Cell> row(const Size& size, const Way& way, const Sample& sample, const Spread& speedup,
                      bool timed) {
  const RankLayout& layout = way.layout;
  const Measurement m = sample.median();
  const Spread time(sample.seconds());
  const auto shown = [&](double value) { return Cell(timed ? value : std::nan("")); };
  const auto us = [&](double seconds) { return shown(1e6 * seconds); };
  return {std::int64_t{m.beads},
          std::string(size.tree ? "tree" : "direct"),
          std::int64_t{layout.workers()},
          timed ? way.name() : way.name() + ", correctness only",
          std::int64_t{layout.ranks},
          std::int64_t{layout.threads},
          us(m.seconds),
          us(time.least),
          us(time.most),
          shown(speedup.median),
          shown(speedup.least),
          shown(speedup.most),
          shown(speedup.median / layout.workers()),
          us(m.seconds - m.exchange - m.wait),
          us(m.exchange),
          us(m.wait),
          m.cores};
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
                  "on a core of its own; more workers than cores show correctness only. Ranks hold the whole "
                  "jet each, or, with the tree, a subdomain of it (parallel distributed).",
                  "treejet-validate scaling --out DIR"});
  const int cores = physical_cores();
  const std::vector<Size> sizes =
      report.quick ? std::vector<Size>{{1, false, 200}, {8, true, 10}}
                   : std::vector<Size>{{1, false, 4000}, {2, false, 2000}, {4, false, 1000}, {8, false, 400},
                                       {22, false, 100}, {75, true, 130},  {750, true, 70}};
  const int repeats = report.quick ? 1 : 9;
  fmt::print("{}, {} physical cores; {}\n", processor_name(), cores,
             mpi_launcher().empty() ? "no MPI: threads only" : mpi_launcher());

  auto table =
      report.table("scaling", "Time of an evaluation, case 3 by its own scheme, every term at every stage",
                   {"beads", "sum", "workers", "kind", "ranks", "threads", "median [us]", "least [us]",
                    "most [us]", "speedup", "least speedup", "most speedup", "efficiency", "compute [us]",
                    "exchange [us]", "wait [us]", "cores"});
  const ProcessorUse processors;
  SmallestShare direct, tree;
  int done = 0, different = 0;
  for (const Size& size : sizes) {
    report.progress("scaling", done++, static_cast<int>(sizes.size()));
    const std::vector<Way> all_ways = ways(cores, size.tree);
    const std::vector<Sample> times = samples(all_ways, size, cores, repeats);
    for (std::size_t k = 0; k < all_ways.size(); ++k) {
      const Way& way = all_ways[k];
      const bool timed = way.layout.workers() <= cores;
      const Measurement m = times[k].median();
      const Spread speedup(speedups(times[0], times[k]));
      table.row(row(size, way, times[k], speedup, timed));
      different += !way.subdomains && m.bits != times[0].median().bits;
      if (timed && !way.layout.serial())
        (size.tree ? tree : direct)
            .add(way.name(), double(m.beads) / way.layout.workers(), speedup.median / way.layout.workers());
    }
  }
  fmt::print("\ndirect sum\n");
  direct.print();
  fmt::print("tree\n");
  tree.print();
  fmt::print("\nothers took {:.0f} % of the processors' time meanwhile{}\n", 100 * processors.by_others(),
             processors.by_others() > 0.05 ? ": these speedups are no measure of the program" : "");
  report.check(
      "teams of workers with replicated data whose last slopes differ from the serial program's in any bit",
      different, 0, 0);
}

}  // namespace treejet
