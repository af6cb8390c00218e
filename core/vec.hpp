#pragma once
/// Vectors of the D-dimensional space a jet lives in (D = 1 or 3), and the column layout of its tables.

#include <Eigen/Core>

namespace treejet {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// One row a bead, one column a quantity: position (D columns), velocity (D), stress (1).
/// Column-major, so each quantity is one contiguous array over the beads.
template <int D>
using Table = Eigen::Array<double, Eigen::Dynamic, 2 * D + 1>;

template <int D>
constexpr int velocity_column = D;
template <int D>
constexpr int stress_column = 2 * D;

template <int D>
Vec<D> position(const Table<D>& y, Eigen::Index i) {
  return y.row(i).template head<D>().matrix().transpose();
}
template <int D>
Vec<D> velocity(const Table<D>& y, Eigen::Index i) {
  return y.row(i).template segment<D>(D).matrix().transpose();
}

}  // namespace treejet
