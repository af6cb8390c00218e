#pragma once
/// Points and charges in the order of a tree's leaves, and beside them the sums made at them: field and, if
/// wanted, potential. The caller's arrays are read once and written once. Points that other ranks have sent
/// stand behind the own ones; no sums are made at them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/archive.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/coulomb/simd/layout.hpp"
#include "parallel/threads.hpp"

namespace treejet {

class OrderedPoints {
 public:
  int size() const { return size_; }
  /// With the grafted ones.
  int all() const { return static_cast<int>(q_.size()); }

  /// A new order; empty: that of the caller.
  void reorder(std::vector<int> order) { order_ = std::move(order); }
  bool in_callers_order() const { return order_.empty(); }
  /// Points that the order is of.
  int ordered() const { return static_cast<int>(order_.size()); }

  /// Takes in points, as many as the order has; those grafted before go.
  void read(const PointCharges<3>& points, Threads threads);

  /// The arrays of coordinates, one after the other, and that of charges: whole, for grafting.
  std::array<std::vector<double>*, 4> columns() { return {&r_[0], &r_[1], &r_[2], &q_}; }
  std::array<const std::vector<double>*, 4> columns() const { return {&r_[0], &r_[1], &r_[2], &q_}; }

  std::int64_t bytes() const {  ///< held
    const std::size_t numbers = 4 * q_.capacity() + 3 * sum_[0].capacity() + sum_[3].capacity();
    return static_cast<std::int64_t>(numbers * sizeof(double) + order_.capacity() * sizeof(int));
  }

  /// The order; FileError if it leaves out a point or has one twice.
  void visit(Archive& state);

  /// Where point k of this order stands in the caller's arrays.
  int source(int k) const { return order_.empty() ? k : order_[static_cast<std::size_t>(k)]; }

  CellPoints points(Rows rows) const {
    return {{r_[0].data(), r_[1].data(), r_[2].data()}, q_.data(), rows.first, rows.size()};
  }

  /// The largest |q| of the own points, or 1 if all are 0.
  double charge_unit() const { return charge_unit_; }

  void keep_potential(bool kept) { sum_[3].resize(kept ? index(size_) : 0); }
  std::array<std::span<const double>, 3> field_sums() const { return {sum_[0], sum_[1], sum_[2]}; }
  /// Three arrays of the field, then that of the potential.
  std::array<double*, 4> sums() { return {sum_[0].data(), sum_[1].data(), sum_[2].data(), sum_[3].data()}; }

  /// Gives the sums at points of this order to those of the caller's `rows`.
  void give(Rows points, Rows rows, const FieldArrays<3>& field, double* potential) const;

 private:
  int size_ = 0;
  std::vector<int> order_;
  std::vector<double> r_[3], q_, sum_[4];
  double charge_unit_ = 1;
};

}  // namespace treejet
