#pragma once
/// All beads of a jet at given times, with their slopes, as validation/reference/independent_jet.py finds
/// them: the tables independent-*.csv. CGS.

#include <cstdint>

#include "validation/support/reference.hpp"
#include "validation/support/run.hpp"

namespace treejet {

/// The greatest error of any bead in any component, cm, cm/s, g/(cm s^2).
struct BeadErrors {
  double position, velocity, stress;
};

inline BeadErrors greatest(const State<3>& difference) {
  return {difference.leftCols<3>().abs().maxCoeff(), difference.middleCols<3>(3).abs().maxCoeff(),
          difference.col(6).abs().maxCoeff()};
}

/// A state in units of length, velocity and stress.
inline State<3> scaled(State<3> y, double length, double velocity, double stress) {
  y.leftCols<3>() *= length;
  y.middleCols<3>(3) *= velocity;
  y.col(6) *= stress;
  return y;
}

struct IndependentBeads {
  double t;              ///< s
  std::int64_t removed;  ///< before the first of these
  bool held;
  State<3> y, slope;

  /// The jet, scaled.
  Jet<3> jet(const Scales& s) const {
    Jet<3> jet;
    jet.t = t / s.time;
    jet.y = scaled(y, 1 / s.length, 1 / s.velocity, 1 / s.stress);
    for (auto* constants : {&jet.mass, &jet.charge, &jet.volume}) constants->setOnes(y.rows());
    jet.held = held;
    jet.removed = removed;
    return jet;
  }

  /// Of a jet, scaled; infinite if it has not the same beads.
  BeadErrors errors(const Jet<3>& jet, const Scales& s) const {
    constexpr double other = std::numeric_limits<double>::infinity();
    if (jet.removed != removed || jet.size() != y.rows() || jet.held != held) return {other, other, other};
    return greatest(scaled(jet.y, s.length, s.velocity, s.stress) - y);
  }
};

/// What a tolerance promises of paper case 3 (core/jet/error_norm.hpp): the greatest error of the position of
/// any bead as the jet arrives, at 10 ms, and once it whips, at 20 ms; cm.
inline double promised(const Parameters& p, double t) {
  return (t < 0.015 ? 16 : 64) * *p.tolerance * p.collector_distance;
}

/// Time after time, from independent-NAME.csv.
inline std::vector<IndependentBeads> independent_beads(const std::string& name) {
  const Reference table("independent-" + name + ".csv");
  const std::vector<double>& t = table["t"];
  std::vector<IndependentBeads> all;
  for (std::size_t first = 0, last; first < t.size(); first = last) {
    for (last = first; last < t.size() && t[last] == t[first];) ++last;
    const auto n = static_cast<Eigen::Index>(last - first);
    const auto column = [&](const char* key) {
      return Eigen::Map<const Eigen::ArrayXd>(table[key].data() + first, n);
    };
    const auto removed = static_cast<std::int64_t>(table("id", first)) - 1;
    IndependentBeads beads{t[first], removed, table("held", first) == 1, State<3>(n), State<3>(n)};
    beads.y << column("x"), column("y"), column("z"), column("vx"), column("vy"), column("vz"),
        column("stress");
    beads.slope << column("vx"), column("vy"), column("vz"), column("ax"), column("ay"), column("az"),
        column("stress_rate");
    all.push_back(std::move(beads));
  }
  return all;
}

}  // namespace treejet
