#include "integrators/march/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
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

/// The least of the rows that `first_wrong` finds in stretches of them, none if it finds `rows` in each.
template <class Search>
std::optional<Eigen::Index> first_row(Eigen::Index rows, const RowSharing& rows_shared, Search first_wrong) {
  std::atomic<Eigen::Index> least = rows;
  for_each_stretch(rows_shared, rows, [&](Eigen::Index first, Eigen::Index count) {
    const Eigen::Index found = first_wrong(first, first + count);
    for (Eigen::Index known = least; found < known && !least.compare_exchange_weak(known, found);) {
    }
  });
  return least < rows ? std::optional<Eigen::Index>(least) : std::nullopt;
}

/// Of an element and its upper neighbour, whether they are in order.
bool in_order(const State<1>&, const State<1>& y, Eigen::Index i) {
  return y(i, 0) > y(i + 1, 0);
}
bool in_order(const State<3>& before, const State<3>& y, Eigen::Index i) {
  const Vec<3> element = position<3>(y, i) - position<3>(y, i + 1);
  return element.dot(position<3>(before, i) - position<3>(before, i + 1)) > 0;
}

std::string out_of_order(const State<1>&, Eigen::Index i) {
  return fmt::format("beads {} and {} of the straight jet have crossed; likely cause: {}", i, i + 1,
                     "the time step is too large, or the charge density too small to keep the beads apart");
}
std::string out_of_order(const State<3>&, Eigen::Index i) {
  return fmt::format("beads {} and {} have swapped sides within one step; likely cause: {}", i, i + 1,
                     "the time step is too large, or the beads have met");
}

std::optional<std::string> behind_nozzle(const State<1>&, const State<1>& y, double /*l_step*/) {
  const Eigen::Index youngest = y.rows() - 1;
  if (youngest < 0 || y(youngest, 0) > 0) return std::nullopt;
  return fmt::format("bead {} has moved back behind the nozzle; likely cause: {}", youngest,
                     "the time step is too large, or the pull of the field too weak to draw a jet");
}
std::optional<std::string> behind_nozzle(const State<3>& before, const State<3>& y, double l_step) {
  const Eigen::Index youngest = y.rows() - 1;
  if (youngest < 0) return std::nullopt;
  // released by a nozzle that circles wide, a bead may start near the middle of the circle
  const double behind = -std::max(l_step, position<3>(before, youngest).norm());
  if (!(before(youngest, 0) > 0 && y(youngest, 0) < behind)) return std::nullopt;
  return fmt::format("bead {} has been thrown behind the nozzle; likely cause: the time step is too large",
                     youngest);
}

}  // namespace

template <int D>
std::optional<std::string> not_finite(const State<D>& before, const State<D>& y, std::int64_t removed,
                                      const RowSharing& rows_shared) {
  const auto wrong = first_row(y.rows(), rows_shared, [&](Eigen::Index i, Eigen::Index end) {
    if (std::isfinite(y.middleRows(i, end - i).sum())) return y.rows();
    while (i < end && y.row(i).isFinite().all()) ++i;
    return i < end ? i : y.rows();
  });
  if (!wrong) return std::nullopt;
  return fmt::format("bead {} (number {} since the start) is no longer finite; likely cause: {}", *wrong,
                     removed + *wrong, likely_cause<D>(before, *wrong));
}

template <int D>
std::optional<std::string> state_check(const State<D>& before, const State<D>& y, double l_step,
                                       std::int64_t removed, const RowSharing& rows_shared) {
  if (auto what = not_finite<D>(before, y, removed, rows_shared)) return what;
  const auto wrong = first_row(y.rows(), rows_shared, [&](Eigen::Index i, Eigen::Index end) {
    end = std::min(end, y.rows() - 1);
    while (i < end && in_order(before, y, i)) ++i;
    return i < end ? i : y.rows();
  });
  if (wrong) return out_of_order(y, *wrong);
  return behind_nozzle(before, y, l_step);
}

template std::optional<std::string> not_finite<1>(const State<1>&, const State<1>&, std::int64_t,
                                                  const RowSharing&);
template std::optional<std::string> not_finite<3>(const State<3>&, const State<3>&, std::int64_t,
                                                  const RowSharing&);
template std::optional<std::string> state_check<1>(const State<1>&, const State<1>&, double, std::int64_t,
                                                   const RowSharing&);
template std::optional<std::string> state_check<3>(const State<3>&, const State<3>&, double, std::int64_t,
                                                   const RowSharing&);

}  // namespace treejet
