#include "forces/coulomb/tree/barnes_hut.hpp"

#include <algorithm>
#include <cmath>

#include "forces/coulomb/tree/multipole.hpp"

namespace treejet {

struct BarnesHut::Walker {
  int i;
  Vector3 r, E{};
  double potential = 0;
  Interactions done{};

  Vector3 from(double x, double y, double z) const { return {r[0] - x, r[1] - y, r[2] - z}; }
};

namespace {

double square(const Vector3& d) {
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

}  // namespace

Interactions BarnesHut::act_on(int leaf, double* const* sums) const {
  const int bottom = cells_.levels() - 1;
  const Rows rows = cells_.leaf_points(leaf);
  Interactions done;
  for (int i = rows.first; i < rows.last; ++i) {
    Walker walker{i, {points_.r[0][i], points_.r[1][i], points_.r[2][i]}};
    std::vector<std::array<int, 2>> open = {{0, 0}};  // level, place in it
    while (!open.empty()) {
      const auto [level, k] = open.back();
      open.pop_back();
      const int cell = cells_.level(level).first + k;
      const Vector3 d = walker.from(cells_.centre(0)[cell], cells_.centre(1)[cell], cells_.centre(2)[cell]);
      const double radius = cells_.radius()[cell];
      if (radius * radius < opening2_ * square(d)) {
        act(cell, walker);
      } else if (level == bottom) {
        act_directly(cells_.leaf_points(k), walker);
      } else {
        const CellRange next = cells_.level(level + 1);
        if (next.first + 2 * k + 1 < next.last) open.push_back({level + 1, 2 * k + 1});
        open.push_back({level + 1, 2 * k});
      }
    }
    for (std::size_t e = 0; e < 3; ++e) sums[e][i] = walker.E[e];
    if (history_.potential) sums[3][i] = walker.potential;
    done += walker.done;
  }
  return done;
}

void BarnesHut::act(int cell, Walker& walker) const {
  Series M(history_.order - 1);
  std::copy_n(history_.moments + static_cast<std::int64_t>(cell) * history_.moment_stride,
              Series::terms(history_.order - 1), M.data());
  const Vector3 d = walker.from(cells_.centre(0)[cell], cells_.centre(1)[cell], cells_.centre(2)[cell]);
  const Vector3 far = m2p(M, d);
  for (std::size_t e = 0; e < 3; ++e) walker.E[e] += far[e];
  if (history_.potential) walker.potential += m2p_potential(M, d);
  ++walker.done.expansions;
}

void BarnesHut::act_directly(Rows near, Walker& walker) const {
  walker.done.pairs += near.size();
  for (int j = near.first; j < near.last; ++j) {
    if (j == walker.i) continue;
    const Vector3 d = walker.from(points_.r[0][j], points_.r[1][j], points_.r[2][j]);
    const double d2 = square(d), potential = points_.q[j] / std::sqrt(d2);
    for (std::size_t e = 0; e < 3; ++e) walker.E[e] += potential / d2 * d[e];
    walker.potential += potential;
  }
}

}  // namespace treejet
