/// Point charges against the slender self-field: whose answers lose their dependence on the length of the
/// elements?

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/support/charged_thread.hpp"
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

/// A jet in elements of several lengths, by points and by slender tubes.
struct Comparison {
  std::string name, title, deck;
  std::vector<std::string> points, slender;  ///< lines of the two
  double window, end;
  std::vector<double> lengths;
};

using Answers = std::vector<std::array<Steady, 2>>;

template <int D>
Answers compare(Report& report, const Comparison& c) {
  auto table = report.table(c.name, c.title, columns_of_answers);
  const double radius = example(c.deck).nozzle_cross;
  Answers found;
  for (std::size_t k = 0; k < c.lengths.size(); ++k) {
    report.progress(c.name, int(k), int(c.lengths.size()));
    const auto with_length = [&](std::vector<std::string> lines) {
      lines.push_back(fmt::format("initial length {}", c.lengths[k]));
      return steady<D>(c.deck, lines, c.window, c.end);
    };
    const std::array<Steady, 2> s = {with_length(c.points), with_length(c.slender)};
    table.row({c.lengths[k], c.lengths[k] / radius, s[0].aperture, s[1].aperture, s[0].path, s[1].path,
               s[0].current, s[1].current, s[0].velocity, s[1].velocity, s[0].radius, s[1].radius});
    found.push_back(s);
  }
  return found;
}

/// By how much an answer changes from the longest elements to the shortest, of itself.
double drift(const Answers& found, std::size_t which, double Steady::*answer) {
  return std::abs(found.back()[which].*answer / (found.front()[which].*answer) - 1);
}

/// By the paper's rule the rate is drawn by the push of the nozzle's charge on the first bead.
void by_pull(Report& report) {
  const std::vector<std::string> points = {"self field point"}, slender = {"self field slender"};
  const auto pvp = compare<3>(
      report,
      {"convergence-pvp", "Case 3 at 9 kV, insertion by the paper's rule", "pvp", points, slender, 0.01, 0.05,
       report.quick ? std::vector{0.04, 0.02} : std::vector{0.04, 0.03, 0.02, 0.015, 0.0125, 0.01}});
  const auto straight = compare<1>(
      report, {"convergence-straight", "Case 2, insertion by the paper's rule", "straight-jet", points,
               slender, 0.1, 1, report.quick ? std::vector{0.4, 0.2} : std::vector{0.4, 0.2, 0.1, 0.05}});
  // of points the push is pi^2/6 lambda^2 whatever their distance, of a tube it falls as the logarithm of
  // element length over radius
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [name, found] : {std::pair{"case 3", &pvp}, std::pair{"case 2", &straight}})
    report.check(
        fmt::format("{}, paper's rule: drift of the current with the length of the elements, slender "
                    "over points (the push of a tube has no limit, that of points has)",
                    name),
        drift(*found, 1, &Steady::current) / drift(*found, 0, &Steady::current), 1, infinite);
}

/// With a given flow the current is known beforehand, and nothing at the nozzle hangs on the elements.
void by_flow(Report& report) {
  const std::string flow = "flow rate 0.0636";  // 90 cm/s at the nozzle
  const auto straight =
      compare<1>(report, {"convergence-fed",
                          "Case 2, fed by flow at 90 cm/s",
                          "straight-jet",
                          {"feed flow", flow},
                          {"self field slender", "feed flow", flow},
                          0.1,
                          1,
                          report.quick ? std::vector{0.4, 0.2} : std::vector{0.4, 0.2, 0.1, 0.05}});
  const double given = example("straight-jet").density_charge * 0.0636;
  for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
    const char* name = which == 0 ? "points" : "slender";
    for (const auto& s : straight)
      // of the 20 beads and more that arrive in a window the last one counts by its way
      report.compare(fmt::format("case 2 by flow, {}: current, statC/s", name), s[which].current,
                     {given, 0.01 * given, "charge density times flow rate"});
  }
  // the point charges' missing self-field is lambda^2 ln 2 a halving, that of tubes has a limit
  report.check("case 2 by flow: drift of the speed with the length of the elements, slender over points",
               drift(straight, 1, &Steady::velocity) / drift(straight, 0, &Steady::velocity), 0, 1);
}

/// A thread without ends to speak of, for which theory has the answer.
void closed_thread(Report& report) {
  const ChargedThread thread;
  auto table =
      report.table("convergence-thread", "Growth rate of a helical wave on a charged thread",
                   {"elements", "element over radius", "points [1/s]", "slender [1/s]", "theory [1/s]"});
  double points_before = 0, points = 0, slender = 0;
  for (const int N : {25, 50, 100, 200}) {
    points_before = points;
    points = thread.growth(N, false);
    const double rate = thread.growth(N, true);
    if (N == 100) slender = rate;
    table.row({std::int64_t{N}, thread.length / N / thread.radius, points, rate, thread.theory()});
  }
  // second order in k l, which is 0.5
  report.compare("closed thread of 100 elements: growth rate, slender, 1/s", slender,
                 {thread.theory(), 0.005 * thread.theory(), "slender-body theory"});
  // lambda^2 k^2 ln 2 a halving, of 2.9 times as much at 100 elements
  report.check("closed thread: growth rate of points, 200 elements over 100 (no limit)",
               points / points_before, 1.1, 1.2);
}

/// The same, integrated in time, until the wave is a quarter of its length high: an endless helix stays one.
void large_wave(Report& report) {
  const LargeWave wave;
  const ChargedThread& thread = wave.thread;
  const double helix = thread.amplification_of_helix(wave.amplitude, wave.seconds);
  auto table = report.table("convergence-helix",
                            "Amplification of a helical wave of 0.004 cm within 0.6 ms, radius 1.25e-3 cm",
                            {"elements in 2 cm", "element over radius", "points", "slender", "endless helix",
                             "small wave: slender", "linear theory"});
  std::vector<double> points, slender;
  double of_small = 0;
  const double linear = std::cosh(thread.theory() * wave.seconds);
  for (const int N : report.quick ? std::vector{50, 100, 200} : std::vector{50, 100, 200, 400}) {
    const int all = int(N * thread.length / 2);
    const auto grown = [&](bool tubes, double amplitude) {
      return thread.amplification(all, tubes, amplitude, wave.seconds, wave.part);
    };
    points.push_back(grown(false, wave.amplitude));
    slender.push_back(grown(true, wave.amplitude));
    of_small = grown(true, wave.small);
    table.row({std::int64_t{N}, thread.length / all / thread.radius, points.back(), slender.back(), helix,
               of_small, linear});
  }
  // at 200 elements k l is 1/4 and chords are 0.3 % shorter than their arcs; the ends of a thread of 16 waves
  // leave 1e-3
  report.compare("closed thread, large wave: amplification of the finest chain of tubes", slender.back(),
                 {helix, 0.005 * helix, "an endless helix, which stays one"});
  report.compare("closed thread, small wave: amplification of the finest chain of tubes", of_small,
                 {linear, 0.005 * linear, "cosh of slender-body theory's rate times the time"});
  // lambda^2 k^2 ln 2 more of the square of the growth rate a halving, forever
  report.check(
      "closed thread, large wave: amplification of points, the last halving of the elements over that of "
      "tubes",
      (points.back() - points[points.size() - 2]) / (slender.back() - slender[slender.size() - 2]), 10,
      std::numeric_limits<double>::infinity());
}

constexpr double shortest_refined = 0.0125;  ///< of adaptive elements; at 2 a_0 they have no room left

/// Case 3 fed by flow: fixed elements, points and tubes, and elements that are split where the jet bends.
void whipping_by_flow(Report& report) {
  const std::vector<double> lengths = report.quick ? std::vector{0.04, 0.02, shortest_refined}
                                                   : std::vector{0.04, 0.03, 0.02, 0.015, shortest_refined};
  const std::string flow = "flow rate 0.01736";  // 221 cm/s, about what the jet draws by the paper's rule
  const auto answer = [&](double length, std::vector<std::string> lines) {
    lines.insert(lines.end(), {flow, fmt::format("initial length {}", length)});
    return steady<3>("pvp", lines, 0.01, 0.05);
  };
  std::vector<std::array<Steady, 3>> found;
  for (const double length : lengths) {
    report.progress("convergence-flow", int(found.size()), int(lengths.size()));
    found.push_back(
        {answer(length, {"feed flow", "surface tension model energy"}), answer(length, {"model slender"}),
         answer(length, {"model slender", "dynamic refinement yes",
                         fmt::format("dynamic refinement tolerance {}", report.quick ? 2e-2 : 1e-2)})});
  }
  auto table =
      report.table("convergence-flow", "Case 3 at 9 kV, fed by flow at 221 cm/s, energy of the surface",
                   {"l_step [cm]", "l_step over radius", "points: aperture [degree]",
                    "slender: aperture [degree]", "adaptive: aperture [degree]", "limit: aperture [degree]",
                    "points: path [cm]", "slender: path [cm]", "adaptive: path [cm]", "limit: path [cm]"});
  const double radius = example("pvp").nozzle_cross;
  const Steady& limit = found.back()[2];
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const auto& s = found[k];
    table.row({lengths[k], lengths[k] / radius, s[0].aperture, s[1].aperture, s[2].aperture, limit.aperture,
               s[0].path, s[1].path, s[2].path, limit.path});
  }
  const auto change = [&](std::size_t which, double Steady::*what) {
    const std::size_t last = lengths.size() - 1,
                      at_4a = std::size_t(std::find(lengths.begin(), lengths.end(), 0.02) - lengths.begin());
    return std::abs(found[last][which].*what / (found[at_4a][which].*what) - 1);
  };
  report.check("case 3 by flow: change of the aperture from l_step 4 a_0 to 2.5 a_0, slender over points",
               change(1, &Steady::aperture) / change(0, &Steady::aperture), 0, 1);
  report.check("case 3 by flow: change of the path from l_step 4 a_0 to 2.5 a_0, slender over points",
               change(1, &Steady::path) / change(0, &Steady::path), 0, 1);
}

/// Elements where the jet needs them: what the spatial tolerance leaves of the error.
void adaptive(Report& report) {
  auto table =
      report.table("convergence-adaptive", "Case 3 by model slender, l_step 4 a_0: tolerance of the elements",
                   {"tolerance of an arc", "aperture [degree]", "path [cm]"});
  const auto with = [&](std::vector<std::string> lines) {
    lines.insert(lines.end(), {"model slender", "flow rate 0.01736"});
    return steady<3>("pvp", lines, 0.01, 0.05);
  };
  const Steady fixed = with({});
  table.row({std::string("fixed"), fixed.aperture, fixed.path});
  std::vector<Steady> found;
  for (const double tolerance :
       report.quick ? std::vector{2e-2, 1e-2} : std::vector{4e-2, 2e-2, 1e-2, 5e-3}) {
    found.push_back(
        with({"dynamic refinement yes", fmt::format("dynamic refinement tolerance {}", tolerance)}));
    table.row({tolerance, found.back().aperture, found.back().path});
  }
  const std::size_t last = found.size() - 1;
  report.check("case 3, adaptive elements: aperture at half of the tolerance over that at all of it",
               found[last].aperture / found[last - 1].aperture, 0.99, 1.01);
  // a turn near the collector has 10 fixed elements, whose chord is 2 % short
  report.check("case 3: aperture by fixed elements over that by adaptive ones",
               fixed.aperture / found[last].aperture, 1.01, 1.05);
}

}  // namespace

void study_convergence(Report& report) {
  report.section(
      {"Point charges against the slender self-field",
       "A chain of point charges knows no fibre radius: the force on its bends grows with each halving of "
       "the elements. With the self-field of a thin tube the force on a given curve converges. What is "
       "left in a jet that the paper's rule of insertion feeds, and in one that a pump feeds?",
       "treejet run examples/pvp/input.dat --out DIR --set \"self field slender\" --set \"initial length "
       "0.01\""});
  closed_thread(report);
  large_wave(report);
  by_pull(report);
  by_flow(report);
  whipping_by_flow(report);
  adaptive(report);
}

}  // namespace treejet
