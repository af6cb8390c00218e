/// The paper's table of processor time per bead and step, for its three schemes on cases 1 and 3.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "validation/support/run.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

struct Published {
  Scheme scheme;
  int evaluations;      ///< of a step
  double case1, case3;  ///< s per bead and step on the authors' machines: one core; four cores
};

const Published published[] = {{Scheme::euler, 1, 4.76e-7, 1.51e-6},
                               {Scheme::heun, 2, 8.64e-7, 2.98e-6},
                               {Scheme::rk4, 4, 16.72e-7, 5.96e-6}};

constexpr double step = 1e-8;  // s, as in the paper

struct Time {
  double seconds;  ///< per bead and step
  double evaluations;
};

/// The middle one of five times on one thread, each from the same jet on.
template <int D>
Time time_of(const Parameters& p, Scheme scheme, const Jet<D>& from, int steps) {
  std::vector<double> seconds;
  Effort effort;
  for (int turn = 0; turn < 5; ++turn) {
    Run<D> run(with_steps(p, scheme, step));
    run.scene.jet = from;
    const auto begin = std::clock();
    effort = run.to(from.t * run.unit.time + steps * step);
    seconds.push_back(double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::sort(seconds.begin(), seconds.end());
  const double done = double(effort.steps);
  return {seconds[2] / done / double(from.size()), double(effort.evaluations) / done};
}

}  // namespace

void study_performance(Report& report) {
  report.section(
      {"Paper: processor time per bead and step",
       "The paper's table for fixed steps of 1e-8 s, beside times on this machine, one thread, every term at "
       "every stage. Its case 3 ran on four cores, wall-clock time. It needs 5e7 such steps for case 3; by "
       "error control 40,000 do.",
       "treejet-validate paper --out DIR"});
  auto table = report.table("performance", "Time per bead and step",
                            {"case", "scheme", "beads", "evaluations per step", "time here [s]",
                             "published [s]", "published / here"});
  Run<1> bead(example("single-bead"));
  Run<3> pvp(example("pvp"));
  pvp.to(0.012);
  const auto row = [&](const std::string& name, const Published& there, double beads, Time here,
                       double time_there) {
    table.row({name, std::string(treejet::name(there.scheme)), beads, here.evaluations, here.seconds,
               time_there, time_there / here.seconds});
  };
  for (const auto& p : published)
    row("case 1", p, 1, time_of<1>(bead.parameters, p.scheme, bead.jet(), report.quick ? 100'000 : 1'000'000),
        p.case1);
  for (const auto& p : published)
    row("case 3", p, double(pvp.jet().size()),
        time_of<3>(pvp.parameters, p.scheme, pvp.jet(), report.quick ? 1000 : 10'000), p.case3);
}

}  // namespace treejet
