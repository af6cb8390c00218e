#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "forces/multirate/history.hpp"
#include "integrators/run/scheme_registry.hpp"
#include "validation/support/experiment.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Case {
  std::string name;
  Parameters p;
  bool events;              ///< whether beads come and go
  double longest_step;      ///< s
  double most_evaluations;  ///< that the shortest fixed step may take; 0: no fixed steps
  double tightest;          ///< tolerance of the reference: where round-off begins
};

std::vector<Case> cases(bool quick) {
  // Case 2 with its collector moved from 200 to 20 cm in the same field: beads arrive after 0.05 s, not 0.2
  // s.
  const std::vector<std::string> near = {"collector distance 20", "external potential 27.78140832",
                                         "final time 0.08", "print time 0.01"};
  return {{"case 1", example("single-bead"), false, 2e-3, quick ? 2e4 : 1e5, 1e-13},
          {"case 2", example("straight-jet", near), true, 4e-4, quick ? 3e5 : 4e5, 1e-12},
          {"case 3", example("pvp", {quick ? "final time 0.0105" : "final time 0.012"}), true, 2e-5,
           quick ? 0 : 3e5, 1e-12}};
}

/// Two solutions at the tightest tolerance, each the judge of the other's scheme; all forces at all stages.
struct Reference {
  Outcome by_verner, by_dormand;

  explicit Reference(const Case& c)
      : by_verner(experiment(with(c.p, {.scheme = Scheme::verner6, .tolerance = c.tightest}))),
        by_dormand(experiment(with(c.p, {.scheme = Scheme::dopri5, .tolerance = c.tightest}))) {}

  const Outcome& independent_of(Scheme scheme) const {
    return scheme == Scheme::verner6 ? by_dormand : by_verner;
  }
  double doubt() const { return distance(by_verner, by_dormand); }
};

/// An error against what was asked for: a timestep in s, or a tolerance.
struct Point {
  double asked, error;
};

/// The power law through some points: slope of the line of least squares in the double logarithmic picture.
struct PowerLaw {
  double exponent, standard_error;
};

PowerLaw power_law(const std::vector<Point>& points) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::ArrayXd u(n), v(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    u[i] = std::log(points[std::size_t(i)].asked);
    v[i] = std::log(points[std::size_t(i)].error);
  }
  u -= u.mean();
  v -= v.mean();
  const double exponent = (u * v).sum() / u.square().sum();
  return {exponent, std::sqrt((v - exponent * u).square().sum() / double(n - 2) / u.square().sum())};
}

class WorkPrecision {
 public:
  explicit WorkPrecision(Report& report)
      : report_(report),
        runs_(report.table(
            "work_precision",
            "Error against work; errors are the greatest distance of a bead from its place in the "
            "reference and, of the oldest bead, that in x",
            {"case", "scheme", "timestep [s]", "tolerance", "error [cm]", "error in x [cm]", "steps",
             "evaluations", "processor time [s]", "ended with"})) {}

  void study(const Case& c) {
    const Reference reference(c);
    const auto& oldest = reference.by_verner;
    report_.check(fmt::format("{}: the two references differ by, cm", c.name), reference.doubt(), 0, 2e-8);
    for (const EventRule events : {EventRule::located, EventRule::step}) {
      if (events == EventRule::step && !c.events) continue;
      for (const Scheme s : {Scheme::euler, Scheme::heun, Scheme::rk4}) fixed(c, reference, s, events);
    }
    for (const Scheme s : {Scheme::dopri5, Scheme::verner6}) {
      adaptive(c, reference, s, Multirate::no);
      if (oldest.position.rows() > fast_region_beads) adaptive(c, reference, s, Multirate::automatic);
    }
  }

  /// The tables that draw conclusions, once all runs are shown.
  void conclude() {
    auto orders = report_.table("orders", "Orders of convergence, fixed steps", conclusion_columns());
    for (const Conclusion& o : orders_)
      orders.row({o.name, o.scheme, o.expected, o.found.exponent, o.found.standard_error, o.points});
    auto tolerances = report_.table("tolerances", "Error as a power of the tolerance", conclusion_columns());
    for (const Conclusion& o : tolerances_)
      tolerances.row({o.name, o.scheme, o.expected, o.found.exponent, o.found.standard_error, o.points});
  }

 private:
  struct Conclusion {
    std::string name, scheme;
    double expected;
    PowerLaw found;
    std::int64_t points;
  };

  static std::vector<std::string> conclusion_columns() {
    return {"case", "scheme", "expected exponent", "measured exponent", "standard error", "runs"};
  }

  double run(const Case& c, const Reference& reference, const Method& method) {
    const Outcome& truth = reference.independent_of(method.scheme);
    const Outcome o = experiment(with(c.p, method), {.repeats = 3});
    const double error = distance(o, truth);
    const bool comparable = std::isfinite(error) && o.removed == truth.removed;
    runs_.row({c.name, name(method), method.timestep.value_or(none), method.tolerance.value_or(none), error,
               comparable ? std::abs(o.x() - truth.x()) : none, o.effort.steps, o.effort.evaluations,
               o.seconds, o.done() ? std::string("end") : fmt::format("exit code {}", o.exit_code)});
    return error;
  }

  /// Order of a scheme with fixed steps, from the shortest steps whose error is small enough to fall in
  /// proportion and large enough to be no error of the reference, nor an epsilon of the way a step. Where
  /// events lie in their steps makes single errors scatter, so the steps are spaced closely, half an octave,
  /// and a line is laid through up to five octaves; where its slope is uncertain by more than the 0.15
  /// allowed, twice its standard error is.
  void fixed(const Case& c, const Reference& reference, Scheme scheme, EventRule events) {
    const Method method{.scheme = scheme, .events = events};
    const int order = stepper<1>(scheme)->order(), expected = events == EventRule::step ? 1 : order;
    const double largest = std::pow(0.03, expected) * reference.by_verner.x(),
                 smallest = 10 * reference.doubt();
    std::vector<Point> points;
    for (double dt = c.longest_step; c.p.final_time / dt * order <= c.most_evaluations; dt /= std::sqrt(2)) {
      Method m = method;
      m.timestep = dt;
      const double error = run(c, reference, m);
      const double round_off =
          c.p.final_time / dt * std::numeric_limits<double>::epsilon() * reference.by_verner.x();
      if (error < largest && error > std::max(smallest, 10 * round_off)) points.push_back({dt, error});
    }
    constexpr std::size_t fit = 11, fewest = 5;
    if (points.size() > fit) points.erase(points.begin(), points.end() - fit);
    if (events == EventRule::step && points.size() < fewest) return;  // too slow to become small
    if (c.most_evaluations == 0) return;
    const PowerLaw found = power_law(points);
    orders_.push_back({c.name, name(method), double(expected), found, std::int64_t(points.size())});
    const double allowed = std::max(0.15, std::min(2 * found.standard_error, 0.4));
    // above the nominal order it is the next term of the error that still shows, one power of the step higher
    report_.compare(fmt::format("{}, {}: order", c.name, name(method)), found.exponent,
                    ClosedAnswer{double(expected), expected - allowed, expected + std::max(allowed, 0.3),
                                 events == EventRule::step ? "first order, as events are up to a step late"
                                                           : "the order of the scheme"});
  }

  /// In the limit of short steps the error is proportional to the tolerance: both fall as step^order. At
  /// loose tolerances events, not the tolerance, end most steps, which lowers the exponent; at 0.5 a
  /// hundredth of the tolerance would still buy a tenth of the error. What raises it is the next term of the
  /// error, one power of the step higher: 1 + 1 / order; half of that more is for errors that are no longer
  /// small at the loose end.
  void adaptive(const Case& c, const Reference& reference, Scheme scheme, Multirate multirate) {
    Method method{.scheme = scheme, .multirate = multirate};
    std::vector<Point> points;
    double worst_rise = 0;
    for (int decade = 4; decade <= 10; ++decade) {
      method.tolerance = std::pow(10, -decade);
      const double error = run(c, reference, method);
      if (!points.empty()) worst_rise = std::max(worst_rise, error / points.back().error);
      points.push_back({*method.tolerance, error});
    }
    const auto what = fmt::format("{}, {}: ", c.name, name(method));
    const PowerLaw found = power_law(points);
    tolerances_.push_back({c.name, name(method), 1., found, std::int64_t(points.size())});
    report_.compare(
        what + "exponent of error against tolerance over six decades", found.exponent,
        ClosedAnswer{1, 0.5, 1 + 1.5 / stepper<1>(scheme)->order(), "the error goes with the tolerance"});
    report_.check(what + "error at a tenth of the tolerance over error, at the worst", worst_rise, 0, 2);
  }

  Report& report_;
  ResultTable runs_;
  std::vector<Conclusion> orders_, tolerances_;
};

}  // namespace

void study_work_precision(Report& report) {
  report.section({"Error against work",
                  "Every scheme on the three cases, with fixed steps and by error control, events located or "
                  "seen at step ends; the truth is an independent scheme at the tightest tolerance.",
                  "treejet-validate time --out DIR"});
  WorkPrecision study(report);
  const auto all = cases(report.quick);
  int done = 0;
  for (const Case& c : all) {
    report.progress("work and precision", done++, int(all.size()));
    study.study(c);
  }
  study.conclude();
}

}  // namespace treejet
