/// Point charges against the slender self-field: whose answers lose their dependence on the length of the
/// elements?

#include <fmt/format.h>

#include <cmath>

#include "validation/support/run.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

struct Steady {
  double aperture, path, current, velocity, radius;
};

/// Means over the last two windows.
template <int D>
Steady steady(const std::string& deck, std::vector<std::string> lines, double window, double end) {
  Run<D> run(example(deck, lines));
  const auto rows = recorded<D>(run,
                                D == 3 ? std::vector<std::string>{"t", "angl", "lp", "fcc", "vc", "rc"}
                                       : std::vector<std::string>{"t", "yz", "lp", "fcc", "vc", "rc"},
                                window, end);
  Steady s{0, 0, 0, 0, 0};
  for (std::size_t row = rows.size() - 2; row < rows.size(); ++row) {
    const auto& r = rows[row];
    s = {s.aperture + r[1] / 2, s.path + r[2] / 2, s.current + r[3] / 2, s.velocity + r[4] / 2,
         s.radius + r[5] / 2};
  }
  return s;
}

const std::vector<std::string> columns_of_answers = {
    "l_step [cm]",       "l_step over radius", "points: aperture [degree]", "slender: aperture [degree]",
    "points: path [cm]", "slender: path [cm]", "points: current [statC/s]", "slender: current [statC/s]",
    "points: vc [cm/s]", "slender: vc [cm/s]", "points: rc [cm]",           "slender: rc [cm]"};

template <int D>
void compare(Report& report, const std::string& name, const std::string& title, const std::string& deck,
             double window, double end, const std::vector<double>& lengths,
             std::vector<std::array<Steady, 2>>& found) {
  auto table = report.table(name, title, columns_of_answers);
  const double radius = example(deck).nozzle_cross;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    report.progress(name, int(k), int(lengths.size()));
    const std::string length = fmt::format("initial length {}", lengths[k]);
    const std::array<Steady, 2> s = {steady<D>(deck, {length, "self field point"}, window, end),
                                     steady<D>(deck, {length, "self field slender"}, window, end)};
    table.row({lengths[k], lengths[k] / radius, s[0].aperture, s[1].aperture, s[0].path, s[1].path,
               s[0].current, s[1].current, s[0].velocity, s[1].velocity, s[0].radius, s[1].radius});
    found.push_back(s);
  }
}

}  // namespace

void study_convergence(Report& report) {
  report.section(
      {"Point charges against the slender self-field",
       "A chain of point charges knows no fibre radius: the force on its bends grows with each halving of "
       "the elements. With the self-field of a thin tube the force on a given curve converges. What is "
       "left in a jet that the paper's rule of insertion feeds?",
       "treejet run examples/pvp/input.dat --out DIR --set \"self field slender\" --set \"initial length "
       "0.01\""});
  std::vector<std::array<Steady, 2>> pvp, straight;
  compare<3>(report, "convergence-pvp", "Case 3 at 9 kV, insertion by the paper's rule", "pvp", 0.01, 0.05,
             report.quick ? std::vector{0.04, 0.02} : std::vector{0.04, 0.03, 0.02, 0.015, 0.0125, 0.01},
             pvp);
  compare<1>(report, "convergence-straight", "Case 2, insertion by the paper's rule", "straight-jet", 0.1, 1,
             report.quick ? std::vector{0.4, 0.2} : std::vector{0.4, 0.2, 0.1, 0.05}, straight);

  const auto lost = [](const std::vector<std::array<Steady, 2>>& found, std::size_t which) {
    return found.back()[which].current / found.front()[which].current;
  };
  report.check("case 3, points: current with the shortest elements over that with the longest", lost(pvp, 0),
               0.9, 1.1);
  report.differs(
      "case 3, slender: current with the shortest elements over that with the longest", lost(pvp, 1),
      {1, 0.3, 0.9,
       "by the paper's rule the push of the nozzle's charge on the first bead draws the jet; of a tube it "
       "falls as the logarithm of element length over radius, so that the rate depends on the elements "
       "more, not less: slender wants a given rate"});
  report.differs("case 2, points: current with the shortest elements over that with the longest",
                 lost(straight, 0),
                 {1, 0.75, 0.97,
                  "the rate that the paper's rule injects has no limit; the self-field along the jet "
                  "is not what drifts"});
  report.differs("case 2, slender: current with the shortest elements over that with the longest",
                 lost(straight, 1),
                 {1, 0.4, 0.95, "as in case 3: the injected rate falls with the element's push"});
}

}  // namespace treejet
