#pragma once
/// A frame: the jet at one instant as files show it, in CGS and in three dimensions whatever the jet's.
///
/// Points are the beads, oldest first, and then the nozzle, so that the polygon through the points is the
/// jet. A bead's id counts the beads since the start from 1; the nozzle has id 0. Quantities of an element -
/// stress, radius a = a_0 sqrt(V l_step / l) - stand at its lower end; the nozzle has stress 0, mass 0,
/// radius a_0 and the charge it stands for in the Coulomb sum, that of a bead. A held bead
/// (core/jet/nozzle.hpp) is no point yet.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/jet/nozzle.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

struct FrameColumn {
  const char* name;
  const char* unit;  ///< in the words of H5MD
  int width;         ///< components
};

inline constexpr std::array<FrameColumn, 6> frame_columns{{{"position", "cm", 3},
                                                           {"velocity", "cm s-1", 3},
                                                           {"stress", "g cm-1 s-2", 1},
                                                           {"charge", "statC", 1},
                                                           {"mass", "g", 1},
                                                           {"radius", "cm", 1}}};

struct Frame {
  std::int64_t step = 0;  ///< counts the frames since the start, as steps of the integrator vary in length
  double time = 0;        ///< s
  std::vector<std::int64_t> id;
  std::array<std::vector<double>, frame_columns.size()> columns;  ///< point by point

  std::size_t points() const { return id.size(); }
};

/// A row of observables at one instant, in the units of core/deck/observable_keys.hpp.
struct Row {
  std::int64_t step = 0;
  double time = 0;  ///< s
  std::vector<double> values;
};

template <int D>
Frame frame(const Jet<D>& jet, const Nozzle<D>& nozzle, const Scales& scales, double nozzle_radius) {
  Frame f;
  f.time = jet.t * scales.time;
  auto& [position, velocity, stress, charge, mass, radius] = f.columns;
  const auto add = [](std::vector<double>& to, const Vec<D>& v, double unit) {
    for (int k = 0; k < 3; ++k) to.push_back(k < D ? unit * v[k < D ? k : 0] : 0);
  };
  const Vec<D> end = nozzle.position(jet.t);
  for (Eigen::Index i = 0; i < jet.size(); ++i) {
    const Vec<D> r = treejet::position<D>(jet.y, i);
    const Vec<D> upper = i + 1 < jet.size() ? treejet::position<D>(jet.y, i + 1) : end;
    f.id.push_back(jet.removed + i + 1);
    add(position, r, scales.length);
    add(velocity, treejet::velocity<D>(jet.y, i), scales.velocity);
    stress.push_back(jet.y(i, stress_column<D>) * scales.stress);
    charge.push_back(jet.charge[i] * scales.charge);
    mass.push_back(jet.mass[i] * scales.mass);
    radius.push_back(nozzle_radius * std::sqrt(jet.volume[i] * nozzle.l_step() / (r - upper).norm()));
  }
  f.id.push_back(0);
  add(position, end, scales.length);
  add(velocity, nozzle.velocity(jet.t), scales.velocity);
  stress.push_back(0);
  charge.push_back(Nozzle<D>::charge * scales.charge);
  mass.push_back(0);
  radius.push_back(nozzle_radius);
  return f;
}

}  // namespace treejet
