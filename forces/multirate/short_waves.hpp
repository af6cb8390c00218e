#pragma once
/// How much a chain of like charges amplifies what differs from one bead to the next.
///
/// The charges of neighbours push each other aside, tension holds them in line. Of the wave that displaces
/// every other bead to the other side the amplitude grows as e^(s t),
///
///     s^2 = 4 / (m l) ( 7/8 zeta(3) q^2 / l^2 - T ) ,      T = pi a^2 sigma ,
///
/// where s^2 > 0; 7/8 zeta(3) is the sum of 1/k^3 over odd k. A bead gets to the place of the one before it
/// in the time l / |v|, so that down the jet the wave grows by e^N, N = sum of s l / |v|. Straight jets have
/// no such waves. Scaled.

#include <cmath>

#include "core/jet/chain.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/scales.hpp"
#include "parallel/rows.hpp"

namespace treejet {

class ShortWaves {
 public:
  explicit ShortWaves(const Parameters& p)
      : repulsion_(1.05179979 * groups(p).Q), tension_(groups(p).L_step * groups(p).F_ve) {}

  /// N of the chain, and what some rows of it have of N.
  template <int D>
  double growth(const Chain<D>& c) const {
    return growth(c, {0, c.beads});
  }
  template <int D>
  double growth(const Chain<D>& c, Rows rows) const {
    double N = 0;
    for (int i = rows.first; D == 3 && i < rows.last && i + 1 < c.beads; ++i) {
      const double k = c.inverse_length[i];
      const double pushed = repulsion_ * c.point_charge[i] * c.point_charge[i + 1] * k * k,
                   held = tension_ * c.volume[i] * c.stress[i] * k;
      const double s2 = 4 * c.inverse_mass[i] * k * (pushed - held);
      if (s2 > 0) N += std::sqrt(s2) / (k * c.velocity(i).norm());
    }
    return N;
  }

 private:
  double repulsion_, tension_;
};

}  // namespace treejet
