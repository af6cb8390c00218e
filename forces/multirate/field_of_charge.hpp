#pragma once
/// The field of a single charge, e = q (r - p) / |r - p|^3, at the first n of some points r. Scaled, without
/// the group Q.

#include <cmath>

#include "core/base/simd_clones.hpp"
#include "core/jet/chain.hpp"

namespace treejet {

/// Adds it to e.
template <int D>
TREEJET_SIMD_CLONES void add_field_of(double charge, const Vec<D>& p, std::array<const double*, D> r,
                                      Eigen::Index n, std::array<double*, D> e) {
  std::array<double, D> source;
  for (int k = 0; k < D; ++k) source[k] = p[k];
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < n; ++i) {
    std::array<double, D> d;
    double d2 = 0;
    for (int k = 0; k < D; ++k) {
      d[k] = r[k][i] - source[k];
      d2 += d[k] * d[k];
    }
    const double w = charge / (d2 * std::sqrt(d2));
    for (int k = 0; k < D; ++k) e[k][i] += w * d[k];
  }
}

template <int D>
typename Chain<D>::Points field_of(double charge, const Vec<D>& p, const typename Chain<D>::Points& point,
                                   Eigen::Index n) {
  typename Chain<D>::Points e = Chain<D>::Points::Zero(n, D);
  add_field_of<D>(charge, p, columns<D>(point), n, columns<D>(e));
  return e;
}

}  // namespace treejet
