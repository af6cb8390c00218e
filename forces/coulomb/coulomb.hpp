#pragma once
/// The Coulomb field of point charges at the points themselves:
///
///     E_i = sum_{j != i} q_j (r_i - r_j) / |r_i - r_j|^3 ,
///
/// in three dimensions also their potential, phi_i = sum_{j != i} q_j / |r_i - r_j|.
///
/// A library of its own: points and charges in, field out; it knows nothing of jets.
/// Invariants: coordinates are D separate contiguous arrays of n doubles; a row of the field depends on the
/// points and charges only, never on how rows are shared among threads or ranks, so its bits are the same for
/// any number of workers. The units are those of q / length^2. Two points at the same place give a non-finite
/// field. Source: paper, Sec. "Equations of motion", net Coulomb force.

#include <array>

#include "forces/coulomb/simd/few_points.hpp"
#include "forces/coulomb/simd/isa.hpp"
#include "parallel/rows.hpp"

namespace treejet {

template <int D>
struct PointCharges {
  std::array<const double*, D> r;
  const double* q;
  int n;
};

template <int D>
using FieldArrays = std::array<double*, D>;  ///< D arrays, indexed by point like the coordinates

/// The reference, written plainly: the rows of E by direct summation in the order of j.
/// `reach` keeps the pairs with |i - j| <= reach only (the deck's cutoff); reach >= n is the whole sum.
template <int D>
void coulomb_plain(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field, int reach);

/// The same whole sum for wide vectors, by the default path of this machine (forces/coulomb/simd/isa.hpp).
template <int D>
void coulomb_direct(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field);

/// The same by a path named by the caller.
template <int D>
void coulomb_direct(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field, Isa isa);

/// Field and potential by a path named by the caller.
void coulomb_direct_with_potential(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
                                   double* potential, Isa isa);

/// The whole field of at most few_points charges, each pair worked out once by Newton's third law: a fifth
/// less work of the kernel, but rows are no longer independent of each other, so that one worker has to do
/// all of it.
template <int D>
void coulomb_mutual(const PointCharges<D>& points, const FieldArrays<D>& field);
template <int D>
void coulomb_mutual(const PointCharges<D>& points, const FieldArrays<D>& field, Isa isa);

/// Shares of rows in whole blocks of this size fill the wide registers.
constexpr int direct_block = 16;

/// The name of the default path: "avx512", "avx2" or "plain".
const char* isa_name();

}  // namespace treejet
