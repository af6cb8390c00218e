#include "core/jet/chain.hpp"

#include <cmath>

#include "core/base/simd_clones.hpp"

namespace treejet {

namespace {

/// The element of a bead, up to its upper neighbour: tangent, inverse length and strain rate from d = r_i -
/// r_up and w = v_i - v_up.
template <int D>
struct Elements {
  std::array<double*, D> tangent;
  double *inverse_length, *strain_rate;

  void set(Eigen::Index i, const std::array<double, D>& d, const std::array<double, D>& w) const {
    double length2 = 0, rate = 0;
    for (int k = 0; k < D; ++k) length2 += d[k] * d[k];
    const double inverse = D == 1 ? 1 / d[0] : 1 / std::sqrt(length2);
    for (int k = 0; k < D; ++k) {
      const double t = d[k] * inverse;
      tangent[k][i] = t;
      rate += w[k] * t;
    }
    inverse_length[i] = inverse;
    strain_rate[i] = rate * inverse;
  }
};

/// Elements that join two rows.
template <int D>
TREEJET_SIMD_CLONES void set_between_rows(Elements<D> element, std::array<const double*, D> r,
                                          std::array<const double*, D> v,
                                          std::pair<Eigen::Index, Eigen::Index> rows) {
#pragma GCC ivdep
  for (Eigen::Index i = rows.first; i < rows.second; ++i) {
    std::array<double, D> d, w;
    for (int k = 0; k < D; ++k) {
      d[k] = r[k][i] - r[k][i + 1];
      w[k] = v[k][i] - v[k][i + 1];
    }
    element.set(i, d, w);
  }
}

}  // namespace

template <int D>
void set_elements(Chain<D>& chain, const Jet<D>& jet, const State<D>& y,
                  std::pair<Eigen::Index, Eigen::Index> rows) {
  const auto [first, last] = rows;
  const Eigen::Index n = y.rows(), m = last - first;
  chain.stress.segment(first, m) = y.col(stress_column<D>).segment(first, m);
  chain.volume.segment(first, m) = jet.volume.segment(first, m);

  const Elements<D> element{columns<D>(chain.tangent), chain.inverse_length.data(), chain.strain_rate.data()};
  set_between_rows<D>(element, columns<D>(y), columns<D>(y, velocity_column<D>),
                      {first, std::min(last, n - 1)});
  if (last < n) return;
  chain.volume[n - 1] += chain.held_mass;
  const Vec<D> above = chain.point.row(chain.points() - 1).transpose(), v_above = chain.nozzle_velocity;
  std::array<double, D> d, w;
  for (int k = 0; k < D; ++k) {
    d[k] = y(n - 1, k) - above[k];
    w[k] = y(n - 1, velocity_column<D> + k) - v_above[k];
  }
  element.set(n - 1, d, w);
}

template void set_elements<1>(Chain<1>&, const Jet<1>&, const State<1>&,
                              std::pair<Eigen::Index, Eigen::Index>);
template void set_elements<3>(Chain<3>&, const Jet<3>&, const State<3>&,
                              std::pair<Eigen::Index, Eigen::Index>);

}  // namespace treejet
