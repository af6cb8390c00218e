#include "forces/coulomb/command/field_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <ostream>

#include "core/base/error.hpp"
#include "forces/coulomb/command/field_error.hpp"
#include "forces/coulomb/command/point_table.hpp"

namespace treejet {

namespace {

/// Seconds of the stages; `choose` is not redone when points move, the others are.
struct Times {
  double choose = 0, build = 0, upward = 0, evaluate = 0;
  double moved() const { return build + upward + evaluate; }
};

template <class F>
double seconds(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The best of the repeats, each of which finds the order of the points anew.
Times timed(const FieldCommand& command, const PointTable& points, CoulombSolver& solver,
            const FieldArrays<3>& field) {
  const Rows all = {0, points.size()};
  const Threads threads = command.threads;
  Times best;
  const double first = seconds([&] { solver.field(points.view(), all, field, threads); });
  const CoulombReport& report = solver.report();
  TreeField tree(default_isa(), {.sharing = command.ranks});
  best.evaluate = std::numeric_limits<double>::infinity();
  for (int k = 0; k < std::max(1, command.repeat); ++k) {
    Times once;
    if (report.direct) {
      once.evaluate = seconds([&] { solver.field(points.view(), all, field, threads); });
    } else {
      once.build = seconds([&] { tree.place(points.view(), report.shape, threads); });
      once.upward = seconds([&] { tree.expand(threads); });
      once.evaluate = seconds([&] { tree.evaluate(tree.leaves_of(all), all, field, threads); });
    }
    if (once.moved() < best.moved()) best = once;
  }
  if (!report.direct && report.coincident > 0) solver.field(points.view(), all, field, threads);
  best.choose = std::max(0.0, first - best.moved());
  return best;
}

std::string method(const CoulombReport& report) {
  if (report.direct) return "direct";
  return report.shape.local ? "tree" : "tree without local expansions";
}

std::string object(const CoulombReport& report, int n, const Times& times, const FieldError* error) {
  std::string text = fmt::format(
      R"({{"n":{},"method":"{}","reason":"{}","isa_name":"{}","order":{},"opening":{:.4g},"leaf":{},"tree":"{}",)"
      R"("block":{},"near_field":"{}","accuracy_expected":{:.3g},"coincident":{},"seconds":{:.6g},"seconds_choose":{:.6g},)"
      R"("seconds_build":{:.6g},"seconds_upward":{:.6g},"seconds_evaluate":{:.6g},"ns_per_point":{:.4g},"interactions":{},)"
      R"("pairs":{},"expansions":{})",
      n, method(report), report.reason, isa_name(), report.direct ? 0 : report.shape.order,
      report.direct ? 0 : report.shape.opening, report.direct ? 0 : report.shape.leaf,
      report.direct            ? "none"
      : report.shape.block > 0 ? "space"
                               : "chain",
      report.shape.block, report.shape.single ? "single" : "double", report.expected_error, report.coincident,
      times.moved(), times.choose, times.build, times.upward, times.evaluate, 1e9 * times.moved() / n,
      report.interactions.pairs + report.interactions.expansions, report.interactions.pairs,
      report.interactions.expansions);
  if (error) {
    const auto& [median, p90, p99, p999, max] = error->to_rms;
    text += fmt::format(
        R"(,"targets":{},"error_l2":{:.4g},"error_median":{:.4g},"error_p90":{:.4g},"error_p99":{:.4g},)"
        R"("error_p999":{:.4g},"error_max":{:.4g},"own_error_median":{:.4g},"own_error_p90":{:.4g},)"
        R"("own_error_p99":{:.4g},"own_error_p999":{:.4g},"own_error_max":{:.4g})",
        error->targets, error->l2, median, p90, p99, p999, max, error->to_own.median, error->to_own.p90,
        error->to_own.p99, error->to_own.p999, error->to_own.max);
  }
  return text + "}\n";
}

std::string lines(const CoulombReport& report, int n, const Times& times, const FieldError* error) {
  std::string text = fmt::format("{} points, {}, vectors: {}\n", n, description(report), isa_name());
  if (report.coincident > 0)
    text += fmt::format("{} points share their place: pairs left out\n", report.coincident);
  text += fmt::format("{} pairs, {} expansions\n", report.interactions.pairs, report.interactions.expansions);
  text += fmt::format(
      "redone when points move: {:.3g} s ({:.4g} ns a point) = build {:.3g} s + upward {:.3g} s + evaluate "
      "{:.3g} s\n",
      times.moved(), 1e9 * times.moved() / n, times.build, times.upward, times.evaluate);
  text += fmt::format("not redone: choice of the method {:.3g} s\n", times.choose);
  if (!error) return text;
  text += fmt::format("error against direct summation at {} of {} points: relative L2 {:.3g}\n",
                      error->targets, n, error->l2);
  for (const auto& [name, q] : {std::pair{"rms field", error->to_rms}, std::pair{"own field", error->to_own}})
    text += fmt::format("  by {}: median {:.2g}, 90 % {:.2g}, 99 % {:.2g}, 99.9 % {:.2g}, max {:.2g}\n", name,
                        q.median, q.p90, q.p99, q.p999, q.max);
  return text;
}

}  // namespace

void run(const FieldCommand& command, std::ostream& report) {
  std::error_code error_code;
  if (!command.out.empty() && std::filesystem::equivalent(command.out, command.points, error_code))
    throw FileError(fmt::format("{}: holds the points; choose another file with --out", command.out));
  const bool keeps = command.existing == OutputFile::Existing::keep;
  if (keeps && !command.out.empty() && std::filesystem::exists(command.out, error_code))
    throw exists_already(command.out);
  const PointTable points = read_points(command.points);
  std::vector<double> E[3];
  for (auto& values : E) values.resize(points.q.size());
  const FieldArrays<3> field = {E[0].data(), E[1].data(), E[2].data()};
  CoulombSolver solver(command.request, default_isa(), {.sharing = command.ranks});
  const Times times = timed(command, points, solver, field);

  FieldError error;
  if (command.compare) error = field_error(points.view(), field, command.threads);
  const FieldError* compared = command.compare ? &error : nullptr;
  report << (command.json ? object(solver.report(), points.size(), times, compared)
                          : lines(solver.report(), points.size(), times, compared));
  if (command.out.empty()) return;
  std::vector<double> beside[3], potential(points.q.size());
  for (auto& values : beside) values.resize(points.q.size());
  solver.field(points.view(), {0, points.size()}, {beside[0].data(), beside[1].data(), beside[2].data()},
               {command.threads}, potential.data());
  if (command.ranks.first()) write_field(command.out, command.existing, points, field, potential.data());
}

}  // namespace treejet
