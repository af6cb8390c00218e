#include "forces/coulomb/tree/ordered_points.hpp"

#include <Eigen/Core>

#include "core/base/error.hpp"

namespace treejet {

void OrderedPoints::read(const PointCharges<3>& points, Threads threads) {
  const auto n = static_cast<std::size_t>(points.n);
  size_ = points.n;
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_, &sum_[0], &sum_[1], &sum_[2]}) values->resize(n);
  for_each_block(threads, {0, points.n}, 4096, [&](Rows rows) {
    for (int k = rows.first; k < rows.last; ++k) {
      const int i = source(k);
      const auto place = static_cast<std::size_t>(k);
      for (std::size_t e = 0; e < 3; ++e) r_[e][place] = points.r[e][i];
      q_[place] = points.q[i];
    }
  });
  charge_unit_ = n > 0 ? Eigen::Map<const Eigen::ArrayXd>(q_.data(), points.n).abs().maxCoeff() : 0;
  if (!(charge_unit_ > 0)) charge_unit_ = 1;
}

void OrderedPoints::visit(Archive& state) {
  state(order_);
  std::vector<bool> seen(order_.size());
  for (const int i : order_) {
    if (i < 0 || index(i) >= seen.size() || seen[index(i)])
      throw FileError("the checkpoint's tree has points in no order");
    seen[index(i)] = true;
  }
}

void OrderedPoints::give(Rows points, Rows rows, const FieldArrays<3>& field, double* potential) const {
  for (int k = points.first; k < points.last; ++k) {
    const int i = source(k);
    if (i < rows.first || i >= rows.last) continue;
    for (std::size_t e = 0; e < 3; ++e) field[e][i] = sum_[e][static_cast<std::size_t>(k)];
    if (potential) potential[i] = sum_[3][static_cast<std::size_t>(k)];
  }
}

}  // namespace treejet
