#include "forces/terms/softened_coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/simd_clones.hpp"
#include "parallel/share_rows.hpp"

namespace treejet {

namespace {

constexpr int block = 16;  ///< rows that are summed side by side, each in the order of the sources

template <int D>
struct Targets {
  double r[D][block], radius[block];
  double older[D][block] = {}, younger[D][block] = {};  ///< pushes of older beads by their mass, of younger
};

template <int D>
struct Sources {
  std::array<const double*, D> r;
  const double *by_mass, *charge, *radius;
};

template <int D>
TREEJET_SIMD_CLONES void add_pushes(Targets<D>& t, const Sources<D>& s, Rows rows, int points) {
  for (int j = 0; j < points; ++j) {
    for (int l = 0; l < block; ++l) {
      const int i = rows.first + l;
      double d[D], R2 = 0;
      for (int k = 0; k < D; ++k) d[k] = t.r[k][l] - s.r[k][j], R2 += d[k] * d[k];
      const double R = std::sqrt(R2), softened = R + (j < i ? t.radius[l] : s.radius[j]);
      const double push = R > 0 ? 1 / (R * softened * softened) : 0;
      const double of_older = j < i ? s.by_mass[j] * push : 0, of_younger = j > i ? s.charge[j] * push : 0;
      for (int k = 0; k < D; ++k) t.older[k][l] += of_older * d[k];
      for (int k = 0; k < D; ++k) t.younger[k][l] += of_younger * d[k];
    }
  }
}

}  // namespace

template <int D>
void SoftenedCoulomb<D>::set_radii(const Chain<D>& c) {
  radius_.setConstant(c.points(), section_.radius);
  const int of_elements = inserting_ ? c.beads - 1 : c.beads;
  for (int i = 0; i < of_elements; ++i)
    radius_[i] = std::sqrt(section_.squared_radius(c.volume[i] * std::abs(c.inverse_length[i])));
  by_mass_.setZero(c.points());
  by_mass_.head(c.beads) = c.point_charge.head(c.beads) * c.inverse_mass;
}

template <int D>
void SoftenedCoulomb<D>::prepare(const Chain<D>& c, Rows, Threads threads) {
  set_radii(c);
  a_.resize(c.beads, Eigen::NoChange);
  share_rows(ranks_, threads, {0, c.beads}, block, columns<D>(a_), [&](Rows some) {
    for (int first = some.first; first < some.last; first += block)
      sum(c, {first, std::min(first + block, some.last)});
  });
}

/// Rows beyond the last one are copies of it, whose sums are thrown away.
template <int D>
void SoftenedCoulomb<D>::sum(const Chain<D>& c, Rows rows) {
  Targets<D> targets;
  for (int l = 0; l < block; ++l) {
    const int i = std::min(rows.first + l, rows.last - 1);
    for (int k = 0; k < D; ++k) targets.r[k][l] = c.point(i, k);
    targets.radius[l] = radius_[i];
  }
  const Sources<D> sources{columns<D>(c.point), by_mass_.data(), c.point_charge.data(), radius_.data()};
  add_pushes<D>(targets, sources, rows, c.points());
  for (int i = rows.first; i < rows.last; ++i)
    for (int k = 0; k < D; ++k)
      a_(i, k) = Q_ * (c.point_charge[i] * targets.older[k][i - rows.first] +
                       by_mass_[i] * targets.younger[k][i - rows.first]);
}

template <int D>
void SoftenedCoulomb<D>::add(const Chain<D>&, Rows rows, Acceleration<D>& a) const {
  a.middleRows(rows.first, rows.size()) += a_.middleRows(rows.first, rows.size());
}

template class SoftenedCoulomb<1>;
template class SoftenedCoulomb<3>;

}  // namespace treejet
