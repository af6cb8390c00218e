#pragma once
/// Points and charges in the order of a tree's leaves, and beside them the sums made at them: field and, if
/// wanted, potential. The caller's arrays are read once and written once.

#include <array>
#include <vector>

#include "core/base/archive.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/coulomb/simd/layout.hpp"
#include "parallel/threads.hpp"

namespace treejet {

class OrderedPoints {
 public:
  int size() const { return static_cast<int>(q_.size()); }

  /// A new order; empty: that of the caller.
  void reorder(std::vector<int> order) { order_ = std::move(order); }
  bool in_callers_order() const { return order_.empty(); }

  /// Takes in points, as many as the order has.
  void read(const PointCharges<3>& points, Threads threads);

  /// The order.
  void visit(Archive& state) { state(order_); }

  /// Where point k of this order stands in the caller's arrays.
  int source(int k) const { return order_.empty() ? k : order_[static_cast<std::size_t>(k)]; }

  CellPoints points(Rows rows) const {
    return {{r_[0].data(), r_[1].data(), r_[2].data()}, q_.data(), rows.first, rows.size()};
  }

  /// The largest |q|, or 1 if all charges are 0.
  double charge_unit() const { return charge_unit_; }

  void keep_potential(bool kept) { sum_[3].resize(kept ? q_.size() : 0); }
  /// Three arrays of the field, then that of the potential.
  std::array<double*, 4> sums() { return {sum_[0].data(), sum_[1].data(), sum_[2].data(), sum_[3].data()}; }

  /// The sums at points of this order to those of the caller's `rows`.
  void give(Rows points, Rows rows, const FieldArrays<3>& field, double* potential) const;

 private:
  std::vector<int> order_;
  std::vector<double> r_[3], q_, sum_[4];
  double charge_unit_ = 1;
};

}  // namespace treejet
