#include "forces/terms/surface_energy.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/simd_clones.hpp"

namespace treejet {

namespace {

/// The arrays of a chain that a bead's capillary tension is made of.
template <int D>
struct Arrays {
  std::array<const double*, D> t;
  const double *inverse_length, *volume, *inverse_mass;
  std::array<double*, D> a;
  double alpha;
  Section section;

  double tension(int element) const {
    return std::numbers::pi * alpha *
           std::sqrt(section.squared_radius(volume[element] * inverse_length[element]));
  }
  void pull(int i, int element, double way) const {
    const double force = way * tension(element) * inverse_mass[i];
    for (int k = 0; k < D; ++k) a[k][i] += force * t[k][element];
  }
};

/// Beads that have an element on either side.
template <int D>
TREEJET_SIMD_CLONES void add_between_elements(Arrays<D> bead, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    bead.pull(i, i, -1);
    bead.pull(i, i - 1, +1);
  }
}

}  // namespace

template <int D>
void SurfaceEnergy<D>::add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const {
  const Arrays<D> bead{columns<D>(c.tangent),
                       c.inverse_length.data(),
                       c.volume.data(),
                       c.inverse_mass.data(),
                       columns<D>(a),
                       alpha_,
                       section_};
  if (rows.first == 0) bead.pull(0, 0, -1);
  add_between_elements(bead, std::max(rows.first, 1), rows.last);
}

/// T is as 1 / sqrt(l):   dT/dd = T / l (1 - 3/2 t t') .
template <int D>
void SurfaceEnergy<D>::differentiate(const Chain<D>& c, LocalJacobian<D>& J) const {
  for (int i = 0; i < c.beads; ++i) {
    const Vec<D> t = c.tangent.row(i).matrix().transpose();
    const double inverse = c.inverse_length[i];
    const double tension =
        std::numbers::pi * alpha_ * std::sqrt(section_.squared_radius(c.volume[i] * inverse));
    J.element[static_cast<std::size_t>(i)].tension_by_d +=
        tension * inverse * (Eigen::Matrix<double, D, D>::Identity() - 1.5 * t * t.transpose());
  }
}

template <int D>
double SurfaceEnergy<D>::energy(const Chain<D>& c) const {
  double sum = 0;
  for (int i = 0; i < c.beads; ++i) {
    const double inverse = c.inverse_length[i];
    sum +=
        2 * std::numbers::pi * alpha_ * std::sqrt(section_.squared_radius(c.volume[i] * inverse)) / inverse;
  }
  return sum;
}

template class SurfaceEnergy<1>;
template class SurfaceEnergy<3>;

}  // namespace treejet
