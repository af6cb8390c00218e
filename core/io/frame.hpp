#pragma once
/// A frame: the jet at one instant as files show it, in CGS and in three dimensions whatever the jet's.
///
/// Points are the beads, oldest first, and then the nozzle, so that the polygon through the points is the
/// jet. A bead's id counts the beads since the start from 1, in the order of their births; the nozzle has id
/// 0. Quantities of an element - stress, radius a = a_0 sqrt(V l_step / l) - stand at its lower end; the
/// nozzle has stress 0, mass 0, radius a_0 and the charge it stands for in the Coulomb sum
/// (core/jet/feed.hpp), and of a column that the scene adds the value that beads are born with. A held bead
/// is no point yet.

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/jet/columns.hpp"
#include "core/jet/material.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

struct FrameColumn {
  std::string name;
  std::string unit;  ///< in the words of H5MD
  int width = 1;     ///< components
};
using FrameColumns = std::vector<FrameColumn>;

/// Those of every jet, position first; behind them those that the scene has added.
FrameColumns frame_columns(const FrameColumns& added = {});

/// Bytes of a point in a file of such columns.
std::size_t bytes_of_point(const FrameColumns& columns);

/// A scene's columns as frames show them.
FrameColumns frame_columns_of(const Columns& added);

/// What a column may be called, so that its name is one word in every format.
bool is_column_name(const std::string& name);

struct Frame {
  std::int64_t step = 0;  ///< counts the frames since the start, as steps of the integrator vary in length
  double time = 0;        ///< s
  std::vector<std::int64_t> id;
  std::vector<std::vector<double>> columns;  ///< of frame_columns, point by point

  std::size_t points() const { return id.size(); }
};

/// A row of observables at one instant, in the units of core/deck/observable_keys.hpp.
struct Row {
  std::int64_t step = 0;
  double time = 0;  ///< s
  std::vector<double> values;
};

/// Points that a frame of a long jet is taken to files in at a time.
inline constexpr std::uint64_t points_at_once = 65'536;

/// Not `to_nozzle`: a part of a frame, without the jet's youngest bead, with which the next part begins.
template <int D>
Frame frame(const Jet<D>& jet, const Nozzle<D>& nozzle, const Scales& scales, double nozzle_radius,
            const Material& material = {}, bool to_nozzle = true) {
  const Columns& added = material.added;
  const Eigen::Index beads = to_nozzle ? jet.size() : jet.size() - 1;
  const auto points = static_cast<std::size_t>(to_nozzle ? beads + 1 : beads);
  Frame f;
  f.time = jet.t * scales.time;
  f.id.reserve(points);
  const FrameColumns columns = frame_columns(frame_columns_of(added));
  for (const FrameColumn& column : columns)
    f.columns.emplace_back().reserve(points * static_cast<std::size_t>(column.width));
  auto &position = f.columns[0], &velocity = f.columns[1], &stress = f.columns[2], &charge = f.columns[3],
       &mass = f.columns[4], &radius = f.columns[5];
  const auto add = [](std::vector<double>& to, const Vec<D>& v, double unit) {
    for (int k = 0; k < 3; ++k) to.push_back(k < D ? unit * v[k < D ? k : 0] : 0);
  };
  const Vec<D> end = nozzle.position(jet.t);
  for (Eigen::Index i = 0; i < beads; ++i) {
    const Vec<D> r = treejet::position<D>(jet.y, i);
    const Vec<D> upper = i + 1 < jet.size() ? treejet::position<D>(jet.y, i + 1) : end;
    f.id.push_back(jet.id.size() > 0 ? jet.id[i] : jet.removed + i + 1);
    add(position, r, scales.length);
    add(velocity, treejet::velocity<D>(jet.y, i), scales.velocity);
    stress.push_back(material.stress<D>(jet, nozzle, i) * scales.stress);
    charge.push_back(jet.charge[i] * scales.charge);
    const double left = material.remaining<D>(jet.y, i);
    mass.push_back(jet.mass[i] * left * scales.mass);
    const double volume = i + 1 < jet.size() ? jet.volume[i] : nozzle.volume_of_youngest(jet);
    radius.push_back(nozzle_radius * std::sqrt(volume * left * nozzle.l_step() / (r - upper).norm()));
  }
  if (to_nozzle) {
    f.id.push_back(0);
    add(position, end, scales.length);
    add(velocity, nozzle.velocity(jet.t), scales.velocity);
    stress.push_back(0);
    charge.push_back(Nozzle<D>::charge * scales.charge);
    mass.push_back(0);
    radius.push_back(nozzle_radius);
  }
  for (std::size_t k = 0; k < added.size(); ++k) {
    std::vector<double>& values = f.columns[columns.size() - added.size() + k];
    for (Eigen::Index i = 0; i < beads; ++i)
      values.push_back(jet.y(i, own_columns<D> + static_cast<Eigen::Index>(k)) * added[k].scale);
    if (to_nozzle) values.push_back(added[k].at_birth * added[k].scale);
  }
  return f;
}

}  // namespace treejet
