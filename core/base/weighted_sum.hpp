#pragma once
/// out = y + sum_j w_j k_j of tables of one shape, in one pass: the algebra of explicit schemes. Without y
/// the sum starts from nothing.

#include <array>

#include "core/base/simd_clones.hpp"
#include "core/base/vec.hpp"

namespace treejet {

template <std::size_t count>
TREEJET_SIMD_CLONES void weighted_sum(const double* y, const std::array<double, count>& w,
                                      const std::array<const double*, count>& k, Eigen::Index n,
                                      double* out) {
  const std::array<double, count> weight = w;
  const std::array<const double*, count> slope = k;
  const bool from_y = y != nullptr;
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = from_y ? y[i] : 0;
    for (std::size_t j = 0; j < count; ++j) sum += weight[j] * slope[j][i];
    out[i] = sum;
  }
}

}  // namespace treejet
