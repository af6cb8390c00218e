#pragma once
/// Vectors of the D-dimensional space a jet lives in (D = 1 or 3), and the column layout of its tables.

#include <Eigen/Core>
#include <array>

namespace treejet {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// One row a bead, one column a quantity: position (D columns), velocity (D), stress (1).
/// Column-major, so each quantity is one contiguous array over the beads.
template <int D>
using State = Eigen::Array<double, Eigen::Dynamic, 2 * D + 1>;

/// `count` columns of a table or of points from column `first` on, each from a row on, for loops over beads.
template <int count, class Array>
std::array<const double*, count> columns(const Array& table, Eigen::Index first = 0, Eigen::Index row = 0) {
  std::array<const double*, count> c;
  for (int k = 0; k < count; ++k) c[k] = table.col(first + k).data() + row;
  return c;
}
template <int count, class Array>
std::array<double*, count> columns(Array& table, Eigen::Index first = 0, Eigen::Index row = 0) {
  std::array<double*, count> c;
  for (int k = 0; k < count; ++k) c[k] = table.col(first + k).data() + row;
  return c;
}

template <int D>
constexpr int velocity_column = D;
template <int D>
constexpr int stress_column = 2 * D;

template <int D>
Vec<D> position(const State<D>& y, Eigen::Index i) {
  return y.row(i).template head<D>().matrix().transpose();
}
template <int D>
Vec<D> velocity(const State<D>& y, Eigen::Index i) {
  return y.row(i).template segment<D>(D).matrix().transpose();
}

/// A table or array without its first row.
template <class Array>
void drop_first_row(Array& a) {
  a = a.bottomRows(a.rows() - 1).eval();
}

}  // namespace treejet
