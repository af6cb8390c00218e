#pragma once
/// T_b += sum_a S_a D_{a+b} for 1 <= |b|, |a| + |b| <= p: nearly all of the work of M2L and L2L
/// (multipole.hpp). For the potential b = 0 is wanted as well; S then goes up to degree p.
///
/// One row of T, b = (0..m, bj, bc) with m = p - bj - bc, stays in registers while all rows of S pass by. Row
/// m is the same code for every order and every (bj, bc), only its place in D differs; it is unrolled by the
/// compiler.

#include "forces/coulomb/simd/series.hpp"

namespace treejet {
namespace {

template <class Registers>
struct Contraction {
  using Pack = Wide<double, Registers::lanes>;

  /// The products with row (., j, c) of S and all the rows after it.
  template <int m, int from, int j, int c>
  __attribute__((always_inline)) static inline void sweep(const Pack* S, const Pack* D, Pack (&T)[m + 1]) {
    constexpr int longest = m - j - c;
#pragma GCC unroll 16
    for (int a = 0; a <= longest; ++a) {
      const Pack s = S[at(a, j, c)];
#pragma GCC unroll 16
      for (int b = from; b <= longest - a; ++b) T[b] += s * D[at(a + b, j, c)];
    }
    if constexpr (longest > 0)
      sweep<m, from, j + 1, c>(S, D, T);
    else if constexpr (c == 0 && m > 0)
      sweep<m, from, 0, 1>(S, D, T);
  }

  template <int m, int from>
  static void row(const Pack* S, const Pack* D, Pack* result) {
    Pack T[m + 1];
#pragma GCC unroll 16
    for (int b = from; b <= m; ++b) T[b] = result[b];
    sweep<m, from, 0, 0>(S, D, T);
#pragma GCC unroll 16
    for (int b = from; b <= m; ++b) result[b] = T[b];
  }

  template <int m, int last_plane>
  static void rows(const Pack* S, const Pack* D, Pack* T, int p) {
    if constexpr (m >= 0) {
      for (int c = 0; c <= last_plane; ++c) {
        const int j = p - m - c;
        if (j >= 0) row<m, 0>(S, D + at(0, j, c) - at(0, 0, 0), T + at(0, j, c));
      }
      rows<m - 1, 1>(S, D, T, p);
    }
  }

  template <int p>
  static void order(const Pack* S, const Pack* D, Pack* T, bool potential) {
    (potential ? row<p, 0> : row<p, 1>)(S, D, T + at(0, 0, 0));
    rows<p - 1, 1>(S, D, T, p);
  }

  static void run(int p, const Pack* S, const Pack* D, Pack* T, bool potential) {
    using Order = void (*)(const Pack*, const Pack*, Pack*, bool);
    static constexpr Order orders[] = {order<2>,  order<3>,  order<4>, order<5>,  order<6>,
                                       order<7>,  order<8>,  order<9>, order<10>, order<11>,
                                       order<12>, order<13>, order<14>};
    orders[p - 2](S, D, T, potential);
  }
};

}  // namespace
}  // namespace treejet
