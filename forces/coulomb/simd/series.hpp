#pragma once
/// The series of multipole.hpp for one register's worth of cells at a time: lane k belongs to the k-th cell.
///
/// On the stack, term (i, j, c) of every degree stands at the same place, rows of i contiguous, rows a fixed
/// distance apart: so the kernels' inner loops serve all orders. Terms with i or j = -1 or -2 are there too,
/// and zero, which spares the recurrences their special cases. In memory (one cell after the other) the terms
/// are packed as in Series::place; `gather` and the sums over lanes move between the two.

#include "forces/coulomb/simd/register.hpp"

namespace treejet {
namespace {

constexpr int highest_order = 14;
constexpr int row_length = highest_order + 3;
constexpr int plane = row_length * row_length;

constexpr int at(int i, int j, int c) {
  return c * plane + (j + 2) * row_length + i + 2;
}

/// Where (i, j, c) stands in memory, in the packed series of a degree: Series::place.
constexpr int packed(int degree, int i, int j, int c) {
  return c * ((degree + 1) * (degree + 2) / 2) + j * (degree + 1 - c) - j * (j - 1) / 2 + i;
}

/// The unused term that takes what pads a packed series.
constexpr int spare = at(highest_order, highest_order, 1);

/// at_[degree][k]: the place on the stack of the k-th packed term. Terms beyond the last, which pad a cell to
/// a multiple of 8, go to `spare`.
struct PackedPlaces {
  static constexpr int longest = ((highest_order + 1) * (highest_order + 1) + 7) / 8 * 8;
  short at_[highest_order + 1][longest]{};
  constexpr PackedPlaces() {
    for (int degree = 0; degree <= highest_order; ++degree) {
      int k = 0;
      for (int c = 0; c <= 1; ++c)
        for (int j = 0; j + c <= degree; ++j)
          for (int i = 0; i + j + c <= degree; ++i) at_[degree][k++] = static_cast<short>(at(i, j, c));
      while (k < longest) at_[degree][k++] = static_cast<short>(spare);
    }
  }
};
constexpr PackedPlaces packed_places;

template <class Registers>
struct WideSeries {
  static constexpr int lanes = Registers::lanes;
  using Pack = Wide<double, lanes>;

  /// The zeros around the terms of a degree, which `polynomials` and `derivatives` read and leave alone.
  static void frame(int degree, Pack* S) {
    for (int c = 0; c <= 1; ++c)
      for (int k = 0; k <= degree; ++k)
        for (int before = 1; before <= 2; ++before) S[at(-before, k, c)] = S[at(k, -before, c)] = Pack{};
  }

  /// P_a(d) for |a| <= degree (multipole.cpp, `polynomials`), in a framed series.
  static void polynomials(int degree, Pack x, Pack y, Pack z, Pack* P) {
    P[at(0, 0, 0)] = Pack{} + 1;
    for (int n = 1; n <= degree; ++n) {
      const double over_n = 1.0 / n;
      for (int j = 0; j <= n; ++j) {
        const int i = n - j;
        P[at(i, j, 0)] = over_n * (x * P[at(i - 1, j, 0)] + y * P[at(i, j - 1, 0)] -
                                   z * (P[at(i - 2, j, 1)] + P[at(i, j - 2, 1)]));
      }
      for (int j = 0; j <= n - 1; ++j) {
        const int i = n - 1 - j;
        P[at(i, j, 1)] = over_n * (x * P[at(i - 1, j, 1)] + y * P[at(i, j - 1, 1)] + z * P[at(i, j, 0)]);
      }
    }
  }

  /// D_a(R) for |a| <= degree (multipole.cpp, `derivatives`), the plane c = 2 included, in a framed series.
  static void derivatives(int degree, Pack x, Pack y, Pack z, Pack* D) {
    const Pack over_R = Registers::over_root(x * x + y * y + z * z), over_R2 = over_R * over_R;
    Pack ix[highest_order + 1], jy[highest_order + 1], ii[highest_order + 1];
    x *= over_R2;
    y *= over_R2;
    z *= over_R2;
    for (int i = 0; i <= degree; ++i) {
      const double real = i;
      ix[i] = real * x;
      jy[i] = real * y;
      ii[i] = real * (real - 1) * over_R2;
    }
    D[at(0, 0, 0)] = over_R;
    for (int n = 1; n <= degree; ++n) {
      const double f = 1.0 / n - 2, g = 1.0 / n - 1;
      for (int j = 0; j <= n; ++j) {
        const int i = n - j;
        D[at(i, j, 0)] = f * (ix[i] * D[at(i - 1, j, 0)] + jy[j] * D[at(i, j - 1, 0)]) +
                         g * (ii[i] * D[at(i - 2, j, 0)] + ii[j] * D[at(i, j - 2, 0)]);
      }
      for (int j = 0; j <= n - 1; ++j) {
        const int i = n - 1 - j;
        D[at(i, j, 1)] = f * (ix[i] * D[at(i - 1, j, 1)] + jy[j] * D[at(i, j - 1, 1)] + z * D[at(i, j, 0)]) +
                         g * (ii[i] * D[at(i - 2, j, 1)] + ii[j] * D[at(i, j - 2, 1)]);
      }
    }
    fold(degree, D);
  }

  /// The plane c = 2 from Laplace's equation.
  static void fold(int degree, Pack* D) {
    for (int j = 0; j + 2 <= degree; ++j)
      for (int i = 0; i + j + 2 <= degree; ++i) D[at(i, j, 2)] = -D[at(i + 2, j, 0)] - D[at(i, j + 2, 0)];
  }

  static void clear(int degree, int planes, Pack* S) {
    for (int c = 0; c < planes; ++c)
      for (int j = 0; j + c <= degree; ++j)
        for (int i = 0; i + j + c <= degree; ++i) S[at(i, j, c)] = Pack{};
    S[spare] = Pack{};
  }

  /// The packed series of `lanes` cells to the stack.
  static void gather(int degree, const double* const* cell, Pack* S) {
    const short* place = packed_places.at_[degree];
    for (int k = 0; k < (degree + 1) * (degree + 1); k += lanes) {
      Pack row[lanes];
      for (int l = 0; l < lanes; ++l) row[l] = load<double, lanes>(cell[l] + k);
      Registers::transpose(row);
      for (int l = 0; l < lanes; ++l) S[place[k + l]] = row[l];
    }
  }

  /// The first `used` lanes of a series on the stack to the packed series of as many cells.
  static void scatter(int degree, const Pack* S, double* const* cell, int used) {
    const short* place = packed_places.at_[degree];
    for (int k = 0; k < (degree + 1) * (degree + 1); k += lanes) {
      Pack row[lanes];
      for (int l = 0; l < lanes; ++l) row[l] = S[place[k + l]];
      Registers::transpose(row);
      for (int l = 0; l < used; ++l) __builtin_memcpy(cell[l] + k, &row[l], sizeof row[l]);
    }
  }

  /// The sums over the lanes, to one packed series.
  static void sum_lanes(int degree, const Pack* S, double* cell) {
    const short* place = packed_places.at_[degree];
    for (int k = 0; k < (degree + 1) * (degree + 1); k += lanes) {
      Pack row[lanes];
      for (int l = 0; l < lanes; ++l) row[l] = S[place[k + l]];
      Registers::transpose(row);
      for (int l = 1; l < lanes; ++l) row[0] += row[l];
      __builtin_memcpy(cell + k, &row[0], sizeof row[0]);
    }
  }
};

}  // namespace
}  // namespace treejet
