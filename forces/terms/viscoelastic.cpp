#include "forces/terms/viscoelastic.hpp"

#include <algorithm>

#include "core/base/simd_clones.hpp"

namespace treejet {

namespace {

/// The arrays of a chain that a bead's viscoelastic force is made of.
template <int D>
struct Arrays {
  std::array<const double*, D> t;
  const double *stress, *inverse_length, *volume, *inverse_mass;
  std::array<double*, D> a;
  double coefficient;

  double tension(int element) const {
    return coefficient * stress[element] * inverse_length[element] * volume[element];
  }

  void pull_up(int i) const {
    const double pull = tension(i);
    for (int k = 0; k < D; ++k) a[k][i] -= pull * t[k][i] * inverse_mass[i];
  }
  void pull_down(int i) const {
    const double pull = tension(i - 1);
    for (int k = 0; k < D; ++k) a[k][i] += pull * t[k][i - 1] * inverse_mass[i];
  }
};

/// Beads that have an element on either side.
template <int D>
TREEJET_SIMD_CLONES void add_between_elements(Arrays<D> bead, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    bead.pull_up(i);
    bead.pull_down(i);
  }
}

}  // namespace

template <int D>
void Viscoelastic<D>::add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const {
  const Arrays<D> bead{columns<D>(c.tangent), c.stress.data(),       c.inverse_length.data(),
                       c.volume.data(),       c.inverse_mass.data(), columns<D>(a),
                       coefficient_};
  if (rows.first == 0) bead.pull_up(0);
  add_between_elements(bead, std::max(rows.first, 1), rows.last);
}

/// T = C V sigma d / l^2:   dT/dd = C V sigma / l^2 (1 - 2 t t') ,   dT/dsigma = C V t / l .
template <int D>
void Viscoelastic<D>::differentiate(const Chain<D>& c, LocalJacobian<D>& J) const {
  for (int i = 0; i < c.beads; ++i) {
    const Vec<D> t = c.tangent.row(i).matrix().transpose();
    const double stiffness =
        coefficient_ * c.volume[i] * c.stress[i] * c.inverse_length[i] * c.inverse_length[i];
    J.element[i].tension_by_d +=
        stiffness * (Eigen::Matrix<double, D, D>::Identity() - 2 * t * t.transpose());
    J.element[i].tension_by_stress += coefficient_ * c.volume[i] * c.inverse_length[i] * t;
  }
}

template class Viscoelastic<1>;
template class Viscoelastic<3>;

}  // namespace treejet
