#include <fmt/format.h>

#include <cmath>

#include "core/jet/scales.hpp"
#include "validation/support/experiment.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

/// The oldest bead at a time, as another program found it.
struct Value {
  std::string deck;
  double t;        ///< s
  double x;        ///< cm
  double allowed;  ///< cm
  Method method;   ///< the one to compare with
};

/// Case 1: JETSPIN's published run, Heun with scaled step 1e-6: ten digits in scaled units.
/// Case 2: JETSPIN's published run; it sees insertions at step ends only, and so must we here. Seven digits
/// are asked for: an event near a step end may fall to either side of it by round-off. Case 3: another
/// program that locates events, in two schemes that agree to the digits given.
std::vector<Value> values(bool quick) {
  const double L = scales(example("single-bead")).length;
  const Method tightest{.tolerance = 1e-14}, tight{.tolerance = 1e-13};
  const Method as_jetspin{.scheme = Scheme::rk4, .timestep = 1e-7, .events = EventRule::step};
  std::vector<Value> v = {{"single-bead", 0.001, 1.068019117 * L, 1e-9 * L, tightest},
                          {"single-bead", 0.01, 3.891966515 * L, 1e-9 * L, tightest},
                          {"single-bead", 0.05, 26.98853006 * L, 1e-8 * L, tightest},
                          {"single-bead", 0.1, 95.85942443 * L, 1e-8 * L, tightest},
                          {"straight-jet", 0.01, 1.949133787, 1e-7, as_jetspin},
                          {"straight-jet", 0.05, 19.10852444, 1e-6, as_jetspin},
                          {"pvp", 0.005, 7.692060, 5e-7, tight},
                          {"pvp", 0.010, 15.697608, 5e-7, tight}};
  if (!quick) {
    v.push_back({"straight-jet", 0.1, 57.25288059, 1e-5, as_jetspin});
    v.push_back({"pvp", 0.015, 15.966332, 5e-7, tight});
    v.push_back({"pvp", 0.020, 15.915786, 5e-7, tight});
    v.push_back({"pvp", 0.050, 15.871799, 5e-7, tight});
  }
  return v;
}

}  // namespace

void study_reference_values(Report& report) {
  report.section({"The oldest bead in other programs",
                  "Where JETSPIN and another program that locates events say it is, computed in the same "
                  "way; and the error of a deck with tolerance 1e-6.",
                  "treejet-validate time --out DIR"});
  auto table = report.table("reference_values", "The oldest bead in other programs",
                            {"deck", "t [s]", "x there [cm]", "x in the same way [cm]", "difference [cm]",
                             "error at tolerance 1e-6 [cm]", "same, multirate [cm]"});
  const auto all = values(report.quick);
  for (std::size_t k = 0; k < all.size(); ++k) {
    report.progress("reference values", int(k), int(all.size()));
    const Value& v = all[k];
    const Parameters p =
        example(v.deck, {fmt::format("final time {}", v.t), fmt::format("print time {}", v.t)});
    const auto x = [&](const Method& m) { return experiment(with(p, m)).x(); };
    const double same = x(v.method), tight = v.method.tolerance ? same : x({.tolerance = 1e-12});
    table.row({v.deck, v.t, fmt::format("{:.10g}", v.x), fmt::format("{:.10g}", same), same - v.x,
               x({.tolerance = 1e-6}) - tight,
               x({.tolerance = 1e-6, .multirate = Multirate::automatic}) - tight});
    report.compare(fmt::format("{}: x at {} s, cm", v.deck, v.t), same,
                   {v.x, v.allowed, "another program, in the same way"});
  }
}

}  // namespace treejet
