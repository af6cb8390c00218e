#pragma once
// clang-format off
/// The mathematics of the fast Coulomb sum, written plainly. Knows no tree; the fast kernels
/// (simd/expansions.hpp) are the same formulas on eight nodes at a time and are tested against these.
///
/// A harmonic function needs no second derivative in z, because d2/dz2 = -d2/dx2 - d2/dy2. So every series
/// here runs over multi-indices a = (i, j, c) with c = 0 or 1 only: 2n+1 of them per degree n = i+j+c, as
/// many as spherical harmonics, yet all real and with products that are single multiplications. With
///
///     D_a(R) = d^a 1/|R|,     P_a(d) = the polynomial that exp(d . grad) leaves in front of d^a,
///
/// a charge q at r - d seen from r + R has the potential sum_a q P_a(-d) D_a(R), hence
///
///     P2M   M_a  = sum_j q_j P_a(centre - r_j)                 moments of a cell
///     M2M   M'_a = sum_b M_b P_{a-b}(centre' - centre)         moved to the parent's centre
///     M2L   L_b  = sum_a M_a D_{a+b}(centre_L - centre_M)      derivatives of the potential at another centre
///     L2L   L'_b = sum_a P_a(centre' - centre) L_{a+b}         moved to a child's centre
///     L2P   E    = -grad sum_b P_b(r - centre) L_b             the field
///     M2P   E    = -grad sum_a M_a D_a(r - centre)             moments to field at once (Barnes-Hut)
///
/// Wherever a+b has c = 2, D_{i,j,2} = -D_{i+2,j,0} - D_{i,j+2,0}. An expansion of order p keeps degrees
/// |a| + |b| <= p; only the field is wanted, so moments stop at degree p-1.
/// Sources: Duan and Krasny, J. Comput. Chem. 22 (2001) 184 (recurrence of D); Dehnen, J. Comput. Phys. 179
/// (2002) 27 (both sides expanded); the reduction to c <= 1 is Hobson's theorem on solid harmonics.
// clang-format on

#include <array>
#include <vector>

namespace treejet {

using Vector3 = std::array<double, 3>;

/// A series of all (i, j, c) with i + j + c <= degree, rows of i contiguous.
class Series {
 public:
  explicit Series(int degree) : degree_(degree), term_(static_cast<std::size_t>(terms(degree)), 0.0) {}
  static int terms(int degree) { return (degree + 1) * (degree + 1); }

  int degree() const { return degree_; }
  double& operator()(int i, int j, int c) { return term_[static_cast<std::size_t>(place(degree_, i, j, c))]; }
  /// Also for c = 2, by Laplace's equation.
  double operator()(int i, int j, int c) const {
    if (c == 2) return -(*this)(i + 2, j, 0) - (*this)(i, j + 2, 0);
    return term_[static_cast<std::size_t>(place(degree_, i, j, c))];
  }
  double* data() { return term_.data(); }
  const double* data() const { return term_.data(); }

  /// Where (i, j, c) stands in a series of this degree.
  static constexpr int place(int degree, int i, int j, int c) {
    return c * ((degree + 1) * (degree + 2) / 2) + j * (degree + 1 - c) - j * (j - 1) / 2 + i;
  }

 private:
  int degree_;
  std::vector<double> term_;
};

Series polynomials(int degree, const Vector3& d);  ///< P_a(d)
Series derivatives(int degree, const Vector3& R);  ///< D_a(R), R not 0

void p2m(const Vector3& centre_minus_r, double q, Series& M);
void m2m(const Series& child, const Vector3& parent_minus_child, Series& parent);
void m2l(const Series& M, const Vector3& R, Series& L);
void l2l(const Series& parent, const Vector3& child_minus_parent, Series& child);
Vector3 l2p(const Series& L, const Vector3& r_minus_centre);
Vector3 m2p(const Series& M, const Vector3& r_minus_centre);

/// The potential beside the field, to one degree less.
double l2p_potential(const Series& L, const Vector3& r_minus_centre);
double m2p_potential(const Series& M, const Vector3& r_minus_centre);

}  // namespace treejet
