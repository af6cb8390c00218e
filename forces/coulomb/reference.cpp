#include <algorithm>
#include <cmath>

#include "forces/coulomb/coulomb.hpp"

namespace treejet {

template <int D>
void coulomb_plain(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field, int reach) {
  for (int i = rows.first; i < rows.last; ++i) {
    double e[D] = {};
    const int begin = reach < i ? i - reach : 0;
    const int end = reach < points.n - 1 - i ? i + reach + 1 : points.n;
    for (int j = begin; j < end; ++j) {
      if (j == i) continue;
      double d[D], d2 = 0;
      for (int k = 0; k < D; ++k) {
        d[k] = points.r[k][i] - points.r[k][j];
        d2 += d[k] * d[k];
      }
      const double distance = D == 1 ? std::abs(d[0]) : std::sqrt(d2);
      const double w = points.q[j] / (d2 * distance);
      for (int k = 0; k < D; ++k) e[k] += w * d[k];
    }
    for (int k = 0; k < D; ++k) field[k][i] = e[k];
  }
}

template void coulomb_plain<1>(const PointCharges<1>&, Rows, const FieldArrays<1>&, int);
template void coulomb_plain<3>(const PointCharges<3>&, Rows, const FieldArrays<3>&, int);

}  // namespace treejet
