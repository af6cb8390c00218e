#pragma once
/// Surface tension pulls a bead towards the centre of the circle through it and its two neighbours,
///
///     f_i = k pi ((a_i + a_{i-1}) / 2)^2 alpha c_i ,      k = 1 / R,
///     a_i = (L_step A / m_i) k / 4 (1 / sqrt(l_i) + 1 / sqrt(l_{i-1}))^2 c_i .
///
/// The oldest bead is a free end and has no curvature. While a bead is held it is the upper neighbour of the
/// youngest one, although l_i reaches to the nozzle (JETSPIN's rule, kept). Source: paper, Sec. "Equations of
/// motion".

#include "forces/term.hpp"

namespace treejet {

/// Curvature times the unit vector to the centre of the circle through a bead and its neighbours at u and s
/// from it.
///
/// Inversion maps that circle on the line through U = u / u^2 and S = s / s^2, whose point nearest to the
/// origin, f, is the image of the far end of the diameter: f = 2 R c / (2 R)^2, hence k c = 2 f. No test for
/// straightness and no small divisor: for collinear beads the line passes through the origin and f = 0 to
/// round-off.
inline Vec<3> curvature(const Vec<3>& u, const Vec<3>& s) {
  const Vec<3> U = u / u.squaredNorm(), along = s / s.squaredNorm() - U;
  return 2 * (U - along * (U.dot(along) / along.squaredNorm()));
}

class SurfaceTension final : public ForceTerm<3> {
 public:
  SurfaceTension(double L_step, double A) : coefficient_(L_step * A / 4) {}
  std::string_view name() const override { return "surface tension"; }

  void add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const override {
    for (int i = rows.first == 0 ? 1 : rows.first; i < rows.last; ++i) {
      const Vec<3> r = c.point.row(i).transpose();
      const Vec<3> down = c.point.row(i - 1).transpose().matrix() - r;
      const Vec<3> up = c.point.row(i + 1).transpose().matrix() - r;
      const double radii = std::sqrt(c.inverse_length[i]) + std::sqrt(c.inverse_length[i - 1]);
      const Vec<3> k = coefficient_ * radii * radii * c.inverse_mass[i] * curvature(down, up);
      a.row(i) += k.transpose().array();
    }
  }

 private:
  double coefficient_;
};

}  // namespace treejet
