/// The PVP jet with longer and shorter elements, everything else the same.

#include <fmt/format.h>

#include <cmath>

#include "validation/support/run.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

constexpr double window = 0.01, steady_from = 0.03;  // s

struct Steady {
  double l_step, beads, vn, vc, current, rc, path, aperture;
};

Steady steady(double l_step) {
  Run<3> run(example("pvp", {fmt::format("initial length {}", l_step)}));
  const auto rows =
      recorded<3>(run, {"t", "n", "vn", "vc", "fcc", "rc", "lp", "angl"}, window, steady_from + 2 * window);
  std::array<double, 8> mean{};
  for (std::size_t row = rows.size() - 2; row < rows.size(); ++row)
    for (std::size_t k = 1; k < mean.size(); ++k) mean[k] += rows[row][k] / 2;
  return {l_step, mean[1], mean[2], mean[3], mean[4], mean[5], mean[6], mean[7]};
}

}  // namespace

void study_resolution(Report& report) {
  report.section({"The length of the elements",
                  "Case 3 with elements of different length, everything else the same: which of its numbers "
                  "are those of "
                  "the jet, and which are those of the elements?",
                  "treejet run examples/pvp/input.dat --out DIR --set \"initial length 0.01\""});
  auto table = report.table("resolution", "Steady state of the PVP jet at 9 kV",
                            {"l_step [cm]", "n", "vn [cm/s]", "vc [cm/s]", "current [statC/s]", "rc [cm]",
                             "path [cm]", "aperture [degree]"});
  std::vector<Steady> found;
  const auto steps = report.quick ? std::vector{0.04, 0.02, 0.01} : std::vector{0.04, 0.02, 0.01, 0.005};
  for (std::size_t k = 0; k < steps.size(); ++k) {
    report.progress("length of the elements", int(k), int(steps.size()));
    found.push_back(steady(steps[k]));
    const Steady& s = found.back();
    table.row({s.l_step, s.beads, s.vn, s.vc, s.current, s.rc, s.path, s.aperture});
  }
  /// Of what is first order in l_step a halving changes half as much as the one before.
  const auto change = [&](double Steady::*what) {
    const Steady* last = &found.back();
    return (last->*what - (last - 1)->*what) / ((last - 1)->*what - (last - 2)->*what);
  };
  for (const auto& [name, what] :
       {std::pair{"current", &Steady::current}, std::pair{"velocity at the nozzle", &Steady::vn},
        std::pair{"velocity at the collector", &Steady::vc}})
    report.check(fmt::format("{}: relative change at the last halving of the elements", name),
                 std::abs(found.back().*what / found[found.size() - 2].*what - 1), 0, 0.01);
  for (const auto& [name, what] :
       {std::pair{"path", &Steady::path}, std::pair{"aperture", &Steady::aperture}})
    report.differs(
        fmt::format("{}: change at the last halving of the elements over that at the one before", name),
        change(what),
        {0.5, 0.8, 1.6,
         "the jet whips the wider the shorter its elements are: the force on a bend of a chain of point "
         "charges grows as the logarithm of its length over the spacing, as the model has no fibre radius in "
         "its Coulomb term"});
}

}  // namespace treejet
