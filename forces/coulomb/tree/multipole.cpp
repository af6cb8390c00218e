#include "forces/coulomb/tree/multipole.hpp"

namespace treejet {

namespace {

template <class F>
void for_each_term(int degree, F&& f) {
  for (int c = 0; c <= 1; ++c)
    for (int j = 0; j + c <= degree; ++j)
      for (int i = 0; i + j + c <= degree; ++i) f(i, j, c);
}

/// sum_b S_a D_{a+b} for every b: M2L and L2L alike.
void contract(const Series& S, const Series& D, Series& result) {
  for_each_term(result.degree(), [&](int bi, int bj, int bc) {
    for_each_term(S.degree(), [&](int i, int j, int c) {
      if (i + j + c + bi + bj + bc <= D.degree())
        result(bi, bj, bc) += S(i, j, c) * D(i + bi, j + bj, c + bc);
    });
  });
}

}  // namespace

/// From n P = d . grad P and dP_a/dx = P_{a-x}, dP_a/dy = P_{a-y}, dP_{ij1}/dz = P_{ij0},
/// dP_{ij0}/dz = -P_{i-2,j,1} - P_{i,j-2,1}.
Series polynomials(int degree, const Vector3& d) {
  Series P(degree);
  const Series& Q = P;
  const auto [x, y, z] = d;
  P(0, 0, 0) = 1;
  for (int n = 1; n <= degree; ++n)
    for (int c = 0; c <= 1; ++c)
      for (int j = 0; j + c <= n; ++j) {
        const int i = n - j - c;
        double sum = 0;
        if (i >= 1) sum += x * Q(i - 1, j, c);
        if (j >= 1) sum += y * Q(i, j - 1, c);
        if (c == 1) sum += z * Q(i, j, 0);
        if (c == 0 && i >= 2) sum -= z * Q(i - 2, j, 1);
        if (c == 0 && j >= 2) sum -= z * Q(i, j - 2, 1);
        P(i, j, c) = sum / n;
      }
  return P;
}

/// n R^2 D_a = -(2n-1) sum_k a_k R_k D_{a-k} - (n-1) sum_k a_k (a_k - 1) D_{a-2k}   (Duan and Krasny).
Series derivatives(int degree, const Vector3& R) {
  Series D(degree);
  const Series& Q = D;
  const auto [x, y, z] = R;
  const double R2 = x * x + y * y + z * z;
  D(0, 0, 0) = 1 / __builtin_sqrt(R2);
  for (int n = 1; n <= degree; ++n)
    for (int c = 0; c <= 1; ++c)
      for (int j = 0; j + c <= n; ++j) {
        const int i = n - j - c;
        double first = 0, second = 0;
        if (i >= 1) first += i * x * Q(i - 1, j, c);
        if (j >= 1) first += j * y * Q(i, j - 1, c);
        if (c == 1) first += z * Q(i, j, 0);
        if (i >= 2) second += i * (i - 1) * Q(i - 2, j, c);
        if (j >= 2) second += j * (j - 1) * Q(i, j - 2, c);
        D(i, j, c) = -((2 * n - 1) * first + (n - 1) * second) / (n * R2);
      }
  return D;
}

void p2m(const Vector3& centre_minus_r, double q, Series& M) {
  const Series P = polynomials(M.degree(), centre_minus_r);
  for_each_term(M.degree(), [&](int i, int j, int c) { M(i, j, c) += q * P(i, j, c); });
}

void m2m(const Series& child, const Vector3& parent_minus_child, Series& parent) {
  const Series P = polynomials(parent.degree(), parent_minus_child);
  for_each_term(child.degree(), [&](int i, int j, int c) {
    for_each_term(parent.degree() - i - j - c, [&](int bi, int bj, int bc) {
      const double product = child(i, j, c) * P(bi, bj, bc);
      if (c + bc < 2) {
        parent(i + bi, j + bj, c + bc) += product;
      } else {
        parent(i + bi + 2, j + bj, 0) -= product;
        parent(i + bi, j + bj + 2, 0) -= product;
      }
    });
  });
}

void m2l(const Series& M, const Vector3& R, Series& L) {
  contract(M, derivatives(L.degree(), R), L);
}

void l2l(const Series& parent, const Vector3& child_minus_parent, Series& child) {
  contract(polynomials(parent.degree(), child_minus_parent), parent, child);
}

Vector3 l2p(const Series& L, const Vector3& r_minus_centre) {
  const Series P = polynomials(L.degree() - 1, r_minus_centre);
  Vector3 E{};
  for_each_term(P.degree(), [&](int i, int j, int c) {
    E[0] -= P(i, j, c) * L(i + 1, j, c);
    E[1] -= P(i, j, c) * L(i, j + 1, c);
    E[2] -= P(i, j, c) * L(i, j, c + 1);
  });
  return E;
}

Vector3 m2p(const Series& M, const Vector3& r_minus_centre) {
  Series L(1);
  contract(M, derivatives(M.degree() + 1, r_minus_centre), L);
  return {-L(1, 0, 0), -L(0, 1, 0), -L(0, 0, 1)};
}

double l2p_potential(const Series& L, const Vector3& r_minus_centre) {
  const Series P = polynomials(L.degree() - 1, r_minus_centre);
  double potential = 0;
  for_each_term(P.degree(), [&](int i, int j, int c) { potential += P(i, j, c) * L(i, j, c); });
  return potential;
}

double m2p_potential(const Series& M, const Vector3& r_minus_centre) {
  Series L(0);
  contract(M, derivatives(M.degree(), r_minus_centre), L);
  return L(0, 0, 0);
}

}  // namespace treejet
