#include <fmt/format.h>

#include "validation/support/experiment.hpp"
#include "validation/support/independent.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

/// The greatest distance in a coordinate of any bead from its place in the independent program, cm.
double error(const Parameters& p, const IndependentBeads& truth) {
  const Outcome o = experiment(p);
  if (!o.done() || o.removed != truth.removed || o.position.rows() != truth.y.rows())
    return std::numeric_limits<double>::infinity();
  return (o.position - truth.y.leftCols<3>()).abs().maxCoeff();
}

}  // namespace

void study_promised_accuracy(Report& report) {
  report.section(
      {"Error promised, error measured",
       "All beads of case 3 against validation/reference/independent_jet.py: the greatest error of "
       "a position for every scheme and tolerance.",
       "treejet-validate time --out DIR"});
  const std::vector<Method> methods = {{.scheme = Scheme::verner6, .multirate = Multirate::automatic},
                                       {.scheme = Scheme::verner6},
                                       {.scheme = Scheme::dopri5},
                                       {.scheme = Scheme::kencarp5}};
  std::vector<std::string> columns = {"t [s]", "tolerance", "promised [cm]"};
  for (const Method& m : methods) columns.push_back(fmt::format("{} [cm]", name(m)));
  auto table = report.table("promised_accuracy", "Greatest error of the position of any bead", columns);
  for (const IndependentBeads& truth : independent_beads("case3")) {
    if (truth.t < 0.01) continue;
    double worst = 0;
    for (int decade = 4; decade <= 9; ++decade) {
      std::vector<Cell> row = {truth.t, std::pow(10, -decade)};
      for (Method m : methods) {
        m.tolerance = std::pow(10, -decade);
        const Parameters p = with(
            example("pvp", {fmt::format("final time {}", truth.t), fmt::format("print time {}", truth.t)}),
            m);
        if (row.size() == 2) row.push_back(promised(p, truth.t));
        const double e = error(p, truth);
        worst = std::max(worst, e / promised(p, truth.t));
        row.push_back(e);
      }
      table.row(row);
    }
    report.check(fmt::format("case 3 at {} s: error over what the tolerance promises, all schemes", truth.t),
                 worst, 0, 1);
  }
}

}  // namespace treejet
