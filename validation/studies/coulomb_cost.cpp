#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forces/coulomb/solver/autotune.hpp"
#include "validation/support/coulomb_trial.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

/// Seconds of the chosen tree over those of the direct sum; without a tree accurate enough, infinite.
double against_direct(const PointSet& set, double accuracy, Isa isa) {
  const CoulombReport choice = chosen(set, {.method = CoulombMethod::tree, .accuracy = accuracy}, isa);
  if (choice.direct) return std::numeric_limits<double>::infinity();
  const double before = direct_seconds(set, isa), tree = tried(set, choice.shape, isa).seconds;
  return tree / std::min(before, direct_seconds(set, isa));
}

/// The number of points from which on the tree is faster, by doubling and then bisection to 10 %.
double crossover(const NamedSet& kind, double accuracy, Isa isa) {
  double low = 200, high = low;
  while (high < 60000 && against_direct(kind.of(static_cast<int>(high)), accuracy, isa) > 1) {
    low = high;
    high *= 2;
  }
  if (high == low) return low;
  while (high > 1.1 * low) {
    const double middle = std::sqrt(low * high);
    (against_direct(kind.of(static_cast<int>(middle)), accuracy, isa) > 1 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

void crossovers(Report& report, const std::vector<NamedSet>& kinds) {
  auto table =
      report.table("coulomb_crossover",
                   "Points from which on a tree is faster than the direct sum on this machine, and the table "
                   "that decides below which `auto` does not look for one",
                   {"charges", "vectors", "accuracy", "measured", "table", "table / measured"});
  for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::plain}) {
    if (!runs_here(isa) || (report.quick && isa != default_isa())) continue;
    for (const double accuracy :
         report.quick ? std::vector<double>{1e-3} : std::vector<double>{1e-3, 1e-5, 1e-7, 1e-9})
      for (const NamedSet& kind : kinds) {
        const double measured = crossover(kind, accuracy, isa), shipped = direct_below(accuracy, isa);
        table.row({kind.name, std::string(name(isa)), accuracy, measured, shipped, shipped / measured});
      }
  }
}

void growth(Report& report, const std::vector<NamedSet>& kinds) {
  auto times = report.table(
      "coulomb_growth", "Time against the number of points",
      {"charges", "accuracy", "N", "order", "opening", "error", "time [s]", "time [ns/point]", "direct [s]"});
  auto slopes =
      report.table("coulomb_slopes", "Growth of the time, as a power of the number of points from 10,000 on",
                   {"charges", "accuracy", "exponent", "exponent of the interactions"});
  std::vector<int> sizes = {1000, 3162, 10000, 31623};
  if (!report.quick) sizes.insert(sizes.end(), {100000, 316228, 1000000});
  for (const NamedSet& kind : kinds)
    for (const double accuracy :
         report.quick ? std::vector<double>{1e-3} : std::vector<double>{1e-3, 1e-5, 1e-7, 1e-9}) {
      std::vector<double> n, seconds, work;
      for (const int size : sizes) {
        const PointSet set = kind.of(size);
        const CoulombReport choice = chosen(set, {.method = CoulombMethod::tree, .accuracy = accuracy});
        const double direct = direct_seconds(set);
        if (choice.direct) continue;
        const CoulombTrial trial = tried(set, choice.shape);
        times.row({kind.name, accuracy, std::int64_t{size}, std::int64_t{choice.shape.order},
                   choice.shape.opening, trial.error.l2, trial.seconds, 1e9 * trial.seconds / size, direct});
        report.check(fmt::format("{}, {} points: error for accuracy {:g}", kind.name, size, accuracy),
                     trial.error.l2, 0, accuracy);
        if (size < 10000) continue;
        n.push_back(size);
        seconds.push_back(trial.seconds);
        work.push_back(cost(trial.interactions, choice.shape, size, default_isa()));
      }
      slopes.row({kind.name, accuracy, log_slope(n, seconds), log_slope(n, work)});
      report.check(fmt::format("{}, accuracy {:g}: exponent of the counted work with N", kind.name, accuracy),
                   log_slope(n, work), 0, 1.3);
    }
}

}  // namespace

void study_coulomb_cost(Report& report) {
  report.section({"The cost of the Coulomb field",
                  "From which number of points on the tree is faster than the direct sum, and how its time "
                  "grows with their number.",
                  "treejet-validate coulomb --out DIR"});
  const auto all = NamedSet::all();
  std::vector<NamedSet> kinds;
  for (const char* wanted : {"whipping jet", "simulated jet", "coil, pitch 1/20"})
    kinds.push_back(*std::ranges::find(all, wanted, &NamedSet::name));
  crossovers(report, kinds);
  growth(report, kinds);
}

}  // namespace treejet
