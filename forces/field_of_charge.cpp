#include "forces/field_of_charge.hpp"

#include <cmath>

#include "core/wide_loops.hpp"

namespace treejet {

namespace {

template <int D>
TREEJET_WIDE_LOOPS void add(double charge, std::array<double, D> source, std::array<const double*, D> r,
                            Eigen::Index n, std::array<double*, D> e) {
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

}  // namespace

template <int D>
void add_field_of(double charge, const Vec<D>& p, std::array<const double*, D> r, Eigen::Index n,
                  std::array<double*, D> e) {
  std::array<double, D> source;
  for (int k = 0; k < D; ++k) source[k] = p[k];
  add<D>(charge, source, r, n, e);
}

template void add_field_of<1>(double, const Vec<1>&, std::array<const double*, 1>, Eigen::Index,
                              std::array<double*, 1>);
template void add_field_of<3>(double, const Vec<3>&, std::array<const double*, 3>, Eigen::Index,
                              std::array<double*, 3>);

}  // namespace treejet
