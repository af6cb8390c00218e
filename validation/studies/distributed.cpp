/// Beyond replicated data: a chain held in subdomains (forces/coulomb/solver/coulomb_solver.hpp). What a rank
/// sends, receives and holds, how accurate its field is, and a model of the time on many ranks.

#include <fmt/format.h>

#include <cmath>

#include "validation/support/distributed_run.hpp"
#include "validation/support/machine.hpp"
#include "validation/support/rank_layout.hpp"
#include "validation/support/scaling_model.hpp"
#include "validation/support/spread.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

constexpr double accuracy = 1e-5;

DistributedMeasurement measured(const std::string& chain, int points, int ranks, int evaluations, int cores) {
  return distributed_measurement(
      output({ranks, 1}, cores,
             fmt::format("distributed-run --chain {} --points {} --accuracy {} --evaluations {}", chain,
                         points, accuracy, evaluations)));
}

struct Case {
  std::string chain;
  int points;
  std::vector<int> ranks;
};

/// The measurement of the longest jet on one rank, which the model stands on.
DistributedMeasurement measure_all(Report& report, const std::vector<Case>& cases) {
  const int cores = physical_cores();
  auto table =
      report.table("distributed", "A chain held in subdomains; numbers of a rank are the largest of any",
                   {"chain", "points", "ranks", "error L2", "bound", "sent [kB]", "received [kB]", "partners",
                    "cells received", "points received", "held [MB]", "process before [MB]", "process [MB]",
                    "work x ranks / work of one", "seconds"});
  DistributedMeasurement base;
  for (const Case& c : cases) {
    DistributedMeasurement alone;
    for (int ranks : c.ranks) {
      const auto m = measured(c.chain, c.points, ranks, report.quick ? 1 : 3, cores);
      if (ranks == 1) alone = m;
      if (ranks == 1 && c.chain == "jet") base = m;
      table.row({c.chain, std::int64_t{m.points}, std::int64_t{m.ranks}, m.error, m.expected, m.sent / 1e3,
                 m.received / 1e3, m.partners, m.cells, m.grafted, m.held / 1e6, m.before / 1e6,
                 m.process / 1e6, m.work * ranks / alone.work,
                 ranks <= cores ? Cell(m.seconds) : Cell(std::nan(""))});
      const std::string what = fmt::format("{} of {} points on {} ranks", c.chain, c.points, ranks);
      report.check("error for accuracy 1e-5, " + what, m.error, 0, accuracy);
      report.check("ranks that send anything else than the model says, to the byte, " + what, m.unlike_model,
                   0, 0);
      // an equal share and as much again for what is seen of others, which long subdomains have less of
      if (c.points / ranks >= 100'000)
        report.check("memory held against an equal share, " + what, m.held * ranks / alone.held, 0, 2);
    }
  }
  return base;
}

/// Where the model can be asked for a time: two ranks from one, by turns.
void compare_times(Report& report) {
  const int cores = physical_cores(), points = report.quick ? 20'000 : 100'000;
  const std::string claim = fmt::format("seconds on 2 ranks against the model's, jet of {} points", points);
  if (cores < 2) return report.not_judged(claim, "there is one core");
  auto table =
      report.table("distributed_time", "Two ranks and the model: a share of the points each, by turns",
                   {"points", "seconds on 1", "seconds on 2", "work of the busier / half of all",
                    "MODEL seconds on 2", "measured / MODEL"});
  const ProcessorUse processors;
  std::vector<double> ratios;
  for (int turn = 0; turn < (report.quick ? 1 : 7); ++turn) {
    const auto one = measured("jet", points, 1, 5, cores), two = measured("jet", points, 2, 5, cores);
    const double model = one.seconds * two.work / one.work;
    ratios.push_back(two.seconds / model);
    table.row(
        {std::int64_t{points}, one.seconds, two.seconds, 2 * two.work / one.work, model, ratios.back()});
  }
  if (report.quick) return report.not_judged(claim, "one turn is too few to judge a time by");
  if (processors.by_others() > 0.05)
    return report.not_judged(claim, fmt::format("others took {:.0f} % of the processors' time; found {:.3g}",
                                                100 * processors.by_others(), Spread(ratios).median));
  // exchange and what both cores share, memory and its bus, are not in it
  report.check(claim, Spread(ratios).median, 0.8, 1.25);
}

void print_model(Report& report, const DistributedMeasurement& base) {
  const LongChain jet("jet");
  const ScalingModel model{base.seconds / base.points};
  auto table = report.table(
      "distributed_model", "MODEL, not a measurement: whipping jets of 1e6 and 1e8 points, and 1e4 a rank",
      {"scaling", "points", "ranks", "partners", "messages [kB]", "summaries [kB]", "messages",
       "MODEL seconds", "of it points", "of it summaries", "of it latency and messages", "MODEL efficiency"});
  const auto row = [&](const std::string& scaling, double points, int ranks) {
    const Volume v = ranks > 1 ? volume(jet, static_cast<int>(points), ranks, base.shape) : Volume{};
    const double seconds = model.seconds(points, ranks, v), work = model.seconds_a_point * points / ranks,
                 summaries = model.seconds_for_summaries(v);
    table.row({scaling, points, std::int64_t{ranks}, v.partners, v.messages / 1e3,
               double(v.summaries.message_bytes) / 1e3, model.messages(ranks, v), seconds, work, summaries,
               seconds - work - summaries, work / seconds});
  };
  const std::vector<int> teams =
      report.quick ? std::vector<int>{1, 100} : std::vector<int>{1, 10, 100, 1000, 10'000};
  const int weak = report.quick ? 1000 : 10'000;
  for (int ranks : teams) row("strong", report.quick ? 1e5 : 1e6, ranks);
  if (!report.quick)
    for (int ranks : {100, 1000, 10'000}) row("strong", 1e8, ranks);
  for (int ranks : teams) row("weak", double(weak) * ranks, ranks);
  fmt::print(
      "\nMODEL, with these assumptions: seconds = points of a rank x {:.3g} us (measured on one rank, one "
      "core of "
      "this machine)\n"
      "  + summaries, which grow with the number of ranks: joining and looking at them and writing messages "
      "(measured here)\n"
      "  + messages x {:.0f} us + bytes / {:.0f} GB/s (both assumed, a common fabric's).\n"
      "  Summaries, messages and partners are counted for the subdomains in the middle and at the end of the "
      "chain.\n"
      "  Order {}, opening {:.3g}, leaves of {} as chosen for accuracy {:g} at {} points. Left out: unequal "
      "work of "
      "subdomains,\n"
      "  contention of the network, work at cells received, all of a step but the field.\n",
      1e6 * model.seconds_a_point, 1e6 * model.latency, 1e-9 * model.bandwidth, base.shape.order,
      base.shape.opening, base.shape.leaf, accuracy, base.points);
}

}  // namespace

void study_distributed(Report& report) {
  report.section({"A chain held in subdomains",
                  "The Coulomb field of chains of which each rank holds a contiguous subdomain: bytes sent, "
                  "memory held, error "
                  "against the direct sum; and a model, not a measurement, of many ranks.",
                  "treejet-validate distributed --out DIR"});
  if (mpi_launcher().empty()) {
    fmt::print("no MPI: nothing to measure\n");
    return;
  }
  fmt::print("{}, {} physical cores; {}\n", processor_name(), physical_cores(), mpi_launcher());
  std::vector<Case> cases;
  for (const int points : report.quick ? std::vector<int>{20'000} : std::vector<int>{100'000, 1'000'000})
    for (const char* chain : {"jet", "coil"}) {
      Case c{chain, points, {1, 2, 3, 5, 8}};
      if (report.quick) c.ranks = {1, 3};
      if (points == 100'000) c.ranks.insert(c.ranks.end(), {16, 32});
      cases.push_back(c);
    }
  const ProcessorUse processors;
  const DistributedMeasurement base = measure_all(report, cases);
  fmt::print("\nothers took {:.0f} % of the processors' time meanwhile\n", 100 * processors.by_others());
  compare_times(report);
  print_model(report, base);
}

}  // namespace treejet
