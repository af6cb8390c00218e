#pragma once
/// Surface tension pulls a bead towards the centre of the circle through it and its two neighbours,
///
///     f_i = k pi ((a_i + a_{i-1}) / 2)^2 alpha c_i ,      k = 1 / R,
///     a_i = (L_step A / m_i) k / 4 (sqrt(V_i / l_i) + sqrt(V_{i-1} / l_{i-1}))^2 c_i .
///
/// The oldest bead is a free end and has no curvature. While a bead is held it is the upper neighbour of the
/// youngest one, although l_i reaches to the nozzle (JETSPIN's rule, kept). Source: paper, Sec. "Equations of
/// motion".

#include <array>

#include "forces/terms/term.hpp"

namespace treejet {

/// Curvature times the unit vector to the centre of the circle through a bead and its neighbours at u and s
/// from it, given U = u / u^2 and S = s / s^2.
///
/// Inversion maps that circle on the line through U and S, whose point nearest to the origin, f, is the image
/// of the far end of the diameter: f = 2 R c / (2 R)^2, hence k c = 2 f. No test for straightness and no
/// small divisor: for collinear beads the line passes through the origin and f = 0 to round-off.
using Triple = std::array<double, 3>;
inline Triple curvature(const Triple& U, const Triple& S) {
  const Triple along = {S[0] - U[0], S[1] - U[1], S[2] - U[2]};
  const double foot = (U[0] * along[0] + U[1] * along[1] + U[2] * along[2]) /
                      (along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
  return {2 * (U[0] - along[0] * foot), 2 * (U[1] - along[1] * foot), 2 * (U[2] - along[2] * foot)};
}

class SurfaceTension final : public ForceTerm<3> {
 public:
  SurfaceTension(double L_step, double A) : coefficient_(L_step * A / 4) {}
  std::string_view name() const override { return "surface tension"; }
  void add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const override;

 private:
  double coefficient_;
};

}  // namespace treejet
