#include <fmt/format.h>

#include <cmath>

#include "validation/support/coulomb_trial.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

constexpr double nanoseconds = 1e9;

std::string tree_kind(const TreeShape& shape) {
  return shape.block == 0 ? "chain" : fmt::format("space by {}", shape.block);
}

/// What is promised: with nothing but the accuracy given, the error stays below it.
void promises(Report& report, ResultTable& table, const NamedSet& kind, int n) {
  const PointSet set = kind.of(n);
  const double direct = direct_seconds(set);
  const std::vector<double> accuracies =
      report.quick ? std::vector<double>{1e-3, 1e-6} : std::vector<double>{1e-3, 1e-5, 1e-7, 1e-9};
  for (const double accuracy : accuracies) {
    const CoulombReport choice = chosen(set, {.method = CoulombMethod::tree, .accuracy = accuracy});
    const TreeShape& s = choice.shape;
    if (choice.direct) {
      table.row({kind.name, std::int64_t{n}, accuracy, std::string("direct"), std::int64_t{0}, 0.,
                 std::int64_t{0}, std::string(), 0., 0., 0., 0., nanoseconds * direct / n, 1.});
      continue;
    }
    const CoulombTrial trial = tried(set, s);
    table.row({kind.name, std::int64_t{n}, accuracy, tree_kind(s), std::int64_t{s.order}, s.opening,
               std::int64_t{s.leaf}, std::string(s.single ? "single" : "double"), choice.expected_error,
               trial.error.l2, trial.error.to_rms.p99, trial.error.to_rms.max,
               nanoseconds * trial.seconds / n, direct / trial.seconds});
    report.check(fmt::format("{}, {} points: error for accuracy {:g}", kind.name, n, accuracy),
                 trial.error.l2, 0, accuracy);
  }
}

/// All shapes: whether the program's choice could have been much better.
void shapes(Report& report, ResultTable& table, const NamedSet& kind, int n) {
  const PointSet set = kind.of(n);
  const CoulombReport usual = chosen(set, {.method = CoulombMethod::tree, .accuracy = 1e-5});
  const auto row = [&](const std::string& way, const TreeShape& shape) {
    const CoulombTrial trial = tried(set, shape);
    table.row({kind.name, std::int64_t{n}, way, std::int64_t{shape.order}, shape.opening,
               std::int64_t{shape.leaf}, trial.error.l2, trial.error.to_rms.max,
               nanoseconds * trial.seconds / n, double(trial.interactions.pairs) / n,
               double(trial.interactions.expansions) / n});
  };
  for (const int block : {0, usual.shape.block > 0 ? usual.shape.block : 4})
    for (const int order :
         report.quick ? std::vector<int>{4, 8} : std::vector<int>{3, 4, 5, 6, 8, 10, 12, 14})
      for (const double opening :
           report.quick ? std::vector<double>{0.4} : std::vector<double>{0.2, 0.3, 0.4, 0.5, 0.6, 0.75})
        row(block == 0 ? "chain" : "space", {order, opening, 32, block, false, true});
  if (!report.quick && usual.shape.block == 0)
    for (const int order : {2, 4, 7})
      for (const double opening : {0.2, 0.4, 0.6}) row("Barnes-Hut", {order, opening, 16, 0, false, false});
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    if (report.quick && accuracy != 1e-4) continue;
    const CoulombReport choice = chosen(set, {.method = CoulombMethod::tree, .accuracy = accuracy});
    if (!choice.direct) row("chosen", choice.shape);
  }
}

}  // namespace

void study_coulomb_accuracy(Report& report) {
  report.section({"The Coulomb field to a stated error",
                  "With nothing but the accuracy given: the error that came of it, against the direct sum, "
                  "on lines, coils, jets and clouds; and all shapes of the tree beside the program's choice.",
                  "treejet-validate coulomb --out DIR"});
  auto kept = report.table(
      "coulomb_accuracy", "With nothing but the accuracy given, one thread",
      {"charges", "N", "accuracy", "tree", "order", "opening", "leaf", "near field", "expected error",
       "error", "99 % of points", "worst point", "time [ns/point]", "direct / tree"});
  const auto sets = NamedSet::all();
  for (const int n : report.quick ? std::vector<int>{3000} : std::vector<int>{3000, 30000, 100000})
    for (const NamedSet& kind : sets) promises(report, kept, kind, n);

  auto swept = report.table("coulomb_shapes",
                            "Sweep of order and opening, leaves of 32, double precision, and the choice",
                            {"charges", "N", "way", "order", "opening", "leaf", "error", "worst point",
                             "time [ns/point]", "pairs a point", "expansions a point"});
  for (const NamedSet& kind : sets) shapes(report, swept, kind, report.quick ? 2000 : 20000);
}

}  // namespace treejet
