#pragma once
/// Vectors of the D-dimensional space a jet lives in (D = 1 or 3), and the state of its beads as a table.

#include <Eigen/Core>
#include <array>

namespace treejet {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// Columns that every state has: position (D), velocity (D), stress (1). Those that a scene adds
/// (core/jet/columns.hpp) follow.
template <int D>
constexpr int velocity_column = D;
template <int D>
constexpr int stress_column = 2 * D;
template <int D>
constexpr int own_columns = 2 * D + 1;

/// The state of the beads, or its slope, or an error of it: one row a bead, one column a quantity.
/// Column-major, so each quantity is one contiguous array over the beads.
template <int D>
class State : public Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic> {
 public:
  using Base = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic>;

  State() : Base(0, own_columns<D>) {}
  explicit State(Eigen::Index rows, Eigen::Index columns = own_columns<D>) : Base(rows, columns) {}
  template <class Expression>
  State(const Eigen::DenseBase<Expression>& e) : Base(e) {}
  template <class Expression>
  State& operator=(const Eigen::DenseBase<Expression>& e) {
    Base::operator=(e);
    return *this;
  }

  /// Columns that a scene has added.
  Eigen::Index added() const { return cols() - own_columns<D>; }
};

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
Vec<D> position(const State<D>& y, Eigen::Index i) {
  return y.row(i).template head<D>().matrix().transpose();
}
template <int D>
Vec<D> velocity(const State<D>& y, Eigen::Index i) {
  return y.row(i).template segment<D>(D).matrix().transpose();
}

/// Drops the first row of a table or array.
template <class Array>
void drop_first_row(Array& a) {
  a = a.bottomRows(a.rows() - 1).eval();
}

}  // namespace treejet
