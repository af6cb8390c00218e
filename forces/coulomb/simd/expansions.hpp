#pragma once
/// The operators of multipole.hpp on `lanes` cells, or `lanes` points of one cell, at a time.

#include "forces/coulomb/simd/contraction.hpp"
#include "forces/coulomb/simd/layout.hpp"

namespace treejet {
namespace {

template <class Registers>
struct ExpansionKernel {
  static constexpr int lanes = Registers::lanes;
  using Pack = Wide<double, lanes>;
  using Terms = WideSeries<Registers>;
  static constexpr double nothing[PackedPlaces::longest] = {};

  /// The largest distance of points from a centre.
  static double reach(const CellPoints& points, const double* centre) {
    Pack largest{};
    for (int k = 0; k < points.count; k += lanes) {
      const int first = points.first + k, left = points.count - k;
      Pack d2{};
      for (int e = 0; e < 3; ++e) {
        const Pack d = load_first<double, lanes>(points.r[e] + first, left) - centre[e];
        d2 += d * d;
      }
      if (left < lanes) d2 = count_from<double, lanes>(0) < left ? d2 : Pack{};
      largest = d2 > largest ? d2 : largest;
    }
    double d2 = largest[0];
    for (int l = 1; l < lanes; ++l) d2 = largest[l] > d2 ? largest[l] : d2;
    return __builtin_sqrt(d2);
  }

  /// M of one cell from its points.
  static void p2m(const Expansions& x, int cell, const CellPoints& points) {
    Pack P[2 * plane], M[2 * plane];
    const int degree = x.order - 1;
    Terms::clear(degree, 2, M);
    Terms::frame(degree, P);
    for (int k = 0; k < points.count; k += lanes) {
      const int left = points.count - k, first = points.first + k;
      Pack d[3] = {};
      for (int e = 0; e < 3; ++e)
        d[e] = x.centre[e][cell] - load_first<double, lanes>(points.r[e] + first, left);
      const Pack q = load_first<double, lanes>(points.q + first, left);
      Terms::polynomials(degree, d[0], d[1], d[2], P);
      for (int c = 0; c <= 1; ++c)
        for (int j = 0; j + c <= degree; ++j)
          for (int i = 0; i + j + c <= degree; ++i) M[at(i, j, c)] += q * P[at(i, j, c)];
    }
    Terms::sum_lanes(degree, M, x.moments + static_cast<long>(cell) * x.moment_stride);
  }

  /// M of the cells `parents`; the children of parents.first + k are children.first + 2k and the next, if
  /// there.
  static void m2m(const Expansions& x, CellRange parents, CellRange children) {
    Pack P[2 * plane], S[2 * plane], T[3 * plane];
    const int degree = x.order - 1;
    Terms::frame(degree, P);
    for (int first = parents.first; first < parents.last; first += lanes) {
      Terms::clear(degree, 3, T);
      double* parent_terms[lanes];
      for (int side = 0; side <= 1; ++side) {
        double d[3][lanes];
        const double* child_terms[lanes];
        for (int l = 0; l < lanes; ++l) {
          const int parent = first + l < parents.last ? first + l : parents.last - 1;
          const int child = children.first + 2 * (parent - parents.first) + side;
          const bool there = child < children.last;
          child_terms[l] = there ? x.moments + static_cast<long>(child) * x.moment_stride : nothing;
          parent_terms[l] = x.moments + static_cast<long>(parent) * x.moment_stride;
          for (int e = 0; e < 3; ++e) d[e][l] = there ? x.centre[e][parent] - x.centre[e][child] : 0.0;
        }
        Terms::gather(degree, child_terms, S);
        Terms::polynomials(degree, in_lanes(d[0]), in_lanes(d[1]), in_lanes(d[2]), P);
        multiply(degree, S, P, T);
      }
      for (int j = 0; j + 2 <= degree; ++j)
        for (int i = 0; i + j + 2 <= degree; ++i) {
          T[at(i + 2, j, 0)] -= T[at(i, j, 2)];
          T[at(i, j + 2, 0)] -= T[at(i, j, 2)];
        }
      const int used = parents.last - first < lanes ? parents.last - first : lanes;
      Terms::scatter(degree, T, parent_terms, used);
    }
  }

  /// L of cell `target` = the sum over the cells `source`, in their order, `lanes` at a time.
  static void m2l(const Expansions& x, int target, const int* source, int count) {
    Pack D[3 * plane], S[2 * plane], T[2 * plane];
    const int p = x.order;
    Terms::clear(p, 2, T);
    if (x.potential) Terms::clear(p, 2, S);
    Terms::frame(p, D);
    for (int k = 0; k < count; k += lanes) {
      int cell[lanes];
      const double* terms[lanes];
      for (int l = 0; l < lanes; ++l) {
        cell[l] = source[k + l < count ? k + l : k];
        terms[l] = k + l < count ? x.moments + static_cast<long>(cell[l]) * x.moment_stride : nothing;
      }
      Pack R[3];
      for (int e = 0; e < 3; ++e) R[e] = x.centre[e][target] - Registers::pick(x.centre[e], cell);
      Terms::derivatives(p, R[0], R[1], R[2], D);
      Terms::gather(p - 1, terms, S);
      Contraction<Registers>::run(p, S, D, T, x.potential);
    }
    Terms::sum_lanes(p, T, x.locals + static_cast<long>(target) * x.local_stride);
  }

  /// Adds to L of the cells `children` what their parents have; parents and children paired as in m2m.
  static void l2l(const Expansions& x, CellRange parents, CellRange children) {
    Pack P[2 * plane], D[3 * plane], T[2 * plane];
    const int p = x.order, degree = x.potential ? p : p - 1;
    Terms::frame(degree, P);
    for (int first = children.first; first < children.last; first += lanes) {
      double d[3][lanes];
      const double* parent_terms[lanes];
      double* child_terms[lanes];
      for (int l = 0; l < lanes; ++l) {
        const int child = first + l < children.last ? first + l : children.last - 1;
        const int parent = parents.first + (child - children.first) / 2;
        parent_terms[l] = x.locals + static_cast<long>(parent) * x.local_stride;
        child_terms[l] = x.locals + static_cast<long>(child) * x.local_stride;
        for (int e = 0; e < 3; ++e) d[e][l] = x.centre[e][child] - x.centre[e][parent];
      }
      Terms::gather(p, parent_terms, D);
      Terms::fold(p, D);
      Terms::polynomials(degree, in_lanes(d[0]), in_lanes(d[1]), in_lanes(d[2]), P);
      Terms::gather(p, child_terms, T);
      Contraction<Registers>::run(p, P, D, T, x.potential);
      const int used = children.last - first < lanes ? children.last - first : lanes;
      Terms::scatter(p, T, child_terms, used);
    }
  }

  /// Adds the field of the local series of a cell at its points, and the potential if the series is made for
  /// it, to three or four arrays in tree order.
  static void l2p(const Expansions& x, int cell, const CellPoints& points, double* const* sums) {
    Pack P[2 * plane];
    const int degree = x.order - 1;
    Terms::frame(degree, P);
    const double* L = x.locals + static_cast<long>(cell) * x.local_stride;
    for (int k = 0; k < points.count; k += lanes) {
      const int left = points.count - k, first = points.first + k;
      Pack d[3], E[3] = {};
      for (int e = 0; e < 3; ++e)
        d[e] = load_first<double, lanes>(points.r[e] + first, left) - x.centre[e][cell];
      Terms::polynomials(degree, d[0], d[1], d[2], P);
      gradient(x.order, L, P, E);
      for (int e = 0; e < 3; ++e) {
        const Pack sum = load_first<double, lanes>(sums[e] + first, left) - E[e];
        store_lanes<double, lanes>(sums[e] + first, sum, 0, left);
      }
      if (!x.potential) continue;
      const Pack sum = load_first<double, lanes>(sums[3] + first, left) + potential(x.order, L, P);
      store_lanes<double, lanes>(sums[3] + first, sum, 0, left);
    }
  }

 private:
  static Pack in_lanes(const double* p) { return load<double, lanes>(p); }

  /// T_{a+b} += S_a P_b, the plane c = 2 kept apart.
  static void multiply(int degree, const Pack* S, const Pack* P, Pack* T) {
    for (int c = 0; c <= 1; ++c)
      for (int j = 0; j + c <= degree; ++j)
        for (int bc = 0; bc <= 1; ++bc)
          for (int bj = 0; bj + bc + j + c <= degree; ++bj) {
            const int longest = degree - j - c - bj - bc;
            for (int t = 0; t <= longest; ++t) {
              Pack sum = T[at(t, j + bj, c + bc)];
              for (int a = 0; a <= t; ++a) sum += S[at(a, j, c)] * P[at(t - a, bj, bc)];
              T[at(t, j + bj, c + bc)] = sum;
            }
          }
  }

  /// sum_b P_b L_b for |b| < p.
  static Pack potential(int p, const double* L, const Pack* P) {
    Pack sum{};
    for (int c = 0; c <= 1; ++c)
      for (int j = 0; j + c < p; ++j)
        for (int i = 0; i + j + c < p; ++i) sum += L[packed(p, i, j, c)] * P[at(i, j, c)];
    return sum;
  }

  /// E = grad sum_b P_b L_b, by dP_{ijc}/dx = P_{i-1,j,c} and its like (multipole.cpp, `l2p`).
  static void gradient(int p, const double* L, const Pack* P, Pack (&E)[3]) {
    for (int c = 0; c <= 1; ++c)
      for (int j = 0; j + c < p; ++j) {
        const double *x = L + packed(p, 1, j, c), *y = L + packed(p, 0, j + 1, c);
        const double *z = L + packed(p, 0, j, 1), *xx = L + packed(p, 2, j, 0),
                     *yy = L + packed(p, 0, j + 2, 0);
        for (int i = 0; i + j + c < p; ++i) {
          const Pack term = P[at(i, j, c)];
          E[0] += term * x[i];
          E[1] += term * y[i];
          E[2] += term * (c == 0 ? z[i] : -(xx[i] + yy[i]));
        }
      }
  }
};

}  // namespace
}  // namespace treejet
