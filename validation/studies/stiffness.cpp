#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/jet/scales.hpp"
#include "integrators/run/scheme_registry.hpp"
#include "validation/support/experiment.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

constexpr Scheme fixed_step_schemes[] = {Scheme::euler, Scheme::heun, Scheme::rk4};
constexpr Scheme tolerance_schemes[] = {Scheme::dopri5, Scheme::verner6};
constexpr double near_enough = 0.1;  ///< of the jet's length: what an unstable run soon misses

struct Case {
  std::string name;
  Parameters p;
};

/// Case 3 with a jet of ten elements from the start, so that a chain moves even where few beads are drawn
/// from the nozzle.
std::vector<Case> cases() {
  const Parameters p =
      example("pvp", {"initial length 0.2", "points 10", "final time 0.001", "print time 0.001"});
  Parameters fine = p, stiff = p, viscous = p, both = p;
  fine.initial_length = 0.02;  // elements of 4e-4 cm, shorter than the nozzle is wide: no deck may say that
  fine.points = 50;
  fine.perturb_amplitude /= 50;  // or the nozzle outruns the elements
  fine.final_time = 1e-4;
  stiff.elastic_modulus *= 1000;
  viscous.viscosity *= 1000;
  both.elastic_modulus *= 1000;
  both.viscosity *= 1000;
  return {{"case 3", p},
          {"l_step / 50", fine},
          {"G x 1000", stiff},
          {"mu x 1000", viscous},
          {"G and mu x 1000", both}};
}

/// Whether a run ends, and ends near the truth.
bool follows(const Outcome& o, const Outcome& truth) {
  return o.done() && o.finite() && std::abs(o.x() - truth.x()) < near_enough * truth.x();
}

/// The largest fixed step, s, from which on shorter ones are stable, to a sixteenth; NaN if it takes more
/// than `most` steps.
double largest_stable_step(const Case& c, Scheme scheme, const Outcome& truth, double most) {
  // a step beyond the limit may come out right by chance, hardly three in a row
  const auto stable = [&](double steps) {
    return std::ranges::all_of(std::array{1., 1.2, 1.5}, [&](double shorter) {
      const Method method{.scheme = scheme, .timestep = c.p.final_time / (steps * shorter)};
      return follows(experiment(with(c.p, method)), truth);
    });
  };
  double enough = 4;
  while (enough <= most && !stable(enough)) enough *= 2;
  if (enough > most) return std::numeric_limits<double>::quiet_NaN();
  double few = enough / 2;
  while (enough > few * 1.0625) {
    const double between = std::sqrt(few * enough);
    (stable(between) ? enough : few) = between;
  }
  return c.p.final_time / enough;
}

/// What limits the step of a scheme with a tolerance: a thousandth of the tolerance takes 10^(3/order) as
/// many steps, three to four times, where the error does, and hardly more where stability does.
std::string bound_by(double steps, double steps_at_a_thousandth) {
  return steps_at_a_thousandth < 1.5 * steps ? "stability" : "accuracy";
}

class StiffnessStudy {
 public:
  explicit StiffnessStudy(Report& report) : report_(report), cases_(cases()) {
    for (const Case& c : cases_) {
      truths_.push_back(experiment(with(c.p, {.scheme = Scheme::dopri5, .tolerance = 1e-12})));
      const Outcome judge = experiment(with(c.p, {.scheme = Scheme::verner6, .tolerance = 1e-12}));
      report.check(fmt::format("{}: the two references differ by, of the jet's length", c.name),
                   distance(truths_.back(), judge) / judge.x(), 0, 1e-6);
    }
  }

  void fixed_steps() {
    std::vector<std::string> columns{"case", "relaxation time [s]", "beads"};
    for (const Scheme s : fixed_step_schemes) columns.push_back(fmt::format("{} [s]", name(s)));
    auto table = report_.table("stable_steps", "The largest stable step of each explicit scheme", columns);
    for (std::size_t k = 0; k < cases_.size(); ++k) {
      report_.progress("stable steps", int(k), int(cases_.size()));
      const Case& c = cases_[k];
      std::vector<Cell> row{c.name, scales(c.p).time, std::int64_t(truths_[k].position.rows())};
      for (const Scheme s : fixed_step_schemes)
        row.push_back(largest_stable_step(c, s, truths_[k], report_.quick ? 4e4 : 1e6));
      table.row(row);
    }
  }

  void tolerances() {
    auto table =
        report_.table("tolerance_steps", "Steps at a tolerance, and the error in x of the oldest bead",
                      {"case", "scheme", "steps at 1e-3", "steps at 1e-6", "steps at 1e-9",
                       "error at 1e-3 [cm]", "error at 1e-6 [cm]", "error at 1e-9 [cm]", "bound by"});
    for (std::size_t k = 0; k < cases_.size(); ++k) {
      for (const Scheme s : tolerance_schemes) tolerance(cases_[k], s, truths_[k], table);
    }
  }

 private:
  void tolerance(const Case& c, Scheme scheme, const Outcome& truth, ResultTable& table) {
    std::vector<Outcome> o;
    std::vector<Cell> row{c.name, std::string(name(scheme))};
    for (const double t : {1e-3, 1e-6, 1e-9})
      o.push_back(experiment(with(c.p, {.scheme = scheme, .tolerance = t})));
    for (const Outcome& each : o) row.push_back(each.effort.steps);
    for (const Outcome& each : o) row.push_back(std::abs(each.x() - truth.x()));
    row.push_back(bound_by(double(o[1].effort.steps), double(o[2].effort.steps)));
    table.row(row);
    const auto what = fmt::format("{}, {}: ", c.name, name(scheme));
    report_.check(what + "1e-3 ends near the truth or stops", o[0].exit_code == 3 || follows(o[0], truth), 1,
                  1);
    report_.check(what + "error at 1e-6, of the jet's length", distance(o[1], truth) / truth.x(), 0, 1e-3);
  }

  Report& report_;
  std::vector<Case> cases_;
  std::vector<Outcome> truths_;
};

}  // namespace

void study_stiffness(Report& report) {
  report.section({"Stiff scenes",
                  "Case 3 with elements up to 50 times as short, a modulus up to 1000 times as great at the "
                  "same viscosity, and viscosities up to 1000 times as great: the largest stable step of "
                  "each explicit scheme, and what a tolerance costs there.",
                  "treejet-validate stability --out DIR"});
  StiffnessStudy study(report);
  study.fixed_steps();
  study.tolerances();
}

}  // namespace treejet
