#include "integrators/march/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace treejet {

namespace {

template <int D>
std::string likely_cause(const State<D>& before, Eigen::Index bead) {
  Eigen::Index nearest = -1;
  double distance = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < before.rows(); ++j) {
    const double d = (position<D>(before, j) - position<D>(before, bead)).norm();
    if (j != bead && d < distance) distance = d, nearest = j;
  }
  const double extent = std::max(1.0, position<D>(before, bead).norm());
  if (nearest >= 0 && distance < 1e-6 * extent) {
    return fmt::format("beads {} and {} have met (scaled distance {:.3g})", bead, nearest, distance);
  }
  return "the time step is too large for the forces: use a smaller timestep, or tolerance instead of "
         "timestep";
}

}  // namespace

template <int D>
std::optional<std::string> not_finite(const State<D>& before, const State<D>& y, std::int64_t removed) {
  if (std::isfinite(y.sum())) return std::nullopt;
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    if (y.row(i).isFinite().all()) continue;
    return fmt::format("bead {} (number {} since the start) is no longer finite; likely cause: {}", i,
                       removed + i, likely_cause<D>(before, i));
  }
  return std::nullopt;
}

template <int D>
std::optional<std::string> state_check(const State<D>& before, const State<D>& y, double l_step,
                                       std::int64_t removed) {
  if (auto what = not_finite<D>(before, y, removed)) return what;
  if constexpr (D == 1) {
    for (Eigen::Index i = 0; i + 1 < y.rows(); ++i) {
      if (y(i, 0) > y(i + 1, 0)) continue;
      return fmt::format(
          "beads {} and {} of the straight jet have crossed; likely cause: {}", i, i + 1,
          "the time step is too large, or the charge density too small to keep the beads apart");
    }
    if (y.rows() > 0 && !(y(y.rows() - 1, 0) > 0)) {
      return fmt::format("bead {} has moved back behind the nozzle; likely cause: {}", y.rows() - 1,
                         "the time step is too large, or the pull of the field too weak to draw a jet");
    }
  } else {
    for (Eigen::Index i = 0; i + 1 < y.rows(); ++i) {
      const Vec<D> element = position<D>(y, i) - position<D>(y, i + 1);
      if (element.dot(position<D>(before, i) - position<D>(before, i + 1)) > 0) continue;
      return fmt::format("beads {} and {} have swapped sides within one step; likely cause: {}", i, i + 1,
                         "the time step is too large, or the beads have met");
    }
    const Eigen::Index youngest = y.rows() - 1;
    if (youngest < 0) return std::nullopt;
    // released by a nozzle that circles wide, a bead may start near the middle of the circle
    const double behind = -std::max(l_step, position<D>(before, youngest).norm());
    if (before(youngest, 0) > 0 && y(youngest, 0) < behind) {
      return fmt::format(
          "bead {} has been thrown behind the nozzle; likely cause: the time step is too large", youngest);
    }
  }
  return std::nullopt;
}

template std::optional<std::string> not_finite<1>(const State<1>&, const State<1>&, std::int64_t);
template std::optional<std::string> not_finite<3>(const State<3>&, const State<3>&, std::int64_t);
template std::optional<std::string> state_check<1>(const State<1>&, const State<1>&, double, std::int64_t);
template std::optional<std::string> state_check<3>(const State<3>&, const State<3>&, double, std::int64_t);

}  // namespace treejet
