#include "forces/terms/surface_tension.hpp"

#include <cmath>

#include "core/base/simd_clones.hpp"

namespace treejet {

namespace {

/// The arrays of a chain that a bead's surface tension is made of.
struct Arrays {
  std::array<const double*, 3> t;
  const double *inverse_length, *volume, *inverse_mass;
  std::array<double*, 3> a;
  double coefficient;

  /// Adds the pull on bead i, whose upper neighbour, inverted, is at S.
  void add(int i, const Triple& S) const {
    const double below = inverse_length[i - 1], above = inverse_length[i];
    const double section_below = volume[i - 1] * below, section_above = volume[i] * above;
    const double radii = section_below + section_above + 2 * std::sqrt(section_below * section_above);
    const Triple k = curvature({below * t[0][i - 1], below * t[1][i - 1], below * t[2][i - 1]}, S);
    const double f = coefficient * radii * inverse_mass[i];
    for (int c = 0; c < 3; ++c) a[c][i] += f * k[c];
  }
};

/// Beads whose upper neighbour is the next row: the tangent points from there.
TREEJET_SIMD_CLONES void add_between_rows(Arrays arrays, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const double above = arrays.inverse_length[i];
    arrays.add(i, {-above * arrays.t[0][i], -above * arrays.t[1][i], -above * arrays.t[2][i]});
  }
}

}  // namespace

void SurfaceTension::add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const {
  const Arrays arrays{columns<3>(c.tangent), c.inverse_length.data(), c.volume.data(),
                      c.inverse_mass.data(), columns<3>(a),           coefficient_};
  const int youngest = c.beads - 1;
  add_between_rows(arrays, std::max(rows.first, 1), std::min(rows.last, youngest));
  if (rows.last <= youngest || youngest == 0) return;
  const Vec<3> up = (c.point.row(youngest + 1) - c.point.row(youngest)).transpose();
  const Vec<3> S = up / up.squaredNorm();
  arrays.add(youngest, {S[0], S[1], S[2]});
}

}  // namespace treejet
