#pragma once
/// The inner loops that exist once per instruction set, as a table of functions.
///
/// Each path is one translation unit (plain.cpp, avx2.cpp, avx512.cpp) compiled for its
/// instruction set. Such a unit must not emit any function another unit could be linked to, or a narrow
/// machine would meet wide code: hence plain pointers in these signatures, and everything behind the table
/// has internal linkage.

#include "forces/coulomb/simd/isa.hpp"
#include "forces/coulomb/simd/layout.hpp"
#include "parallel/rows.hpp"

namespace treejet {

struct WideKernels {
  /// Rows of the field of n charges at D coordinate arrays (coulomb.hpp).
  using Direct = void (*)(const double* const* r, const double* q, int n, Rows rows, double* const* field);
  Direct direct_1d, direct_3d;
  Direct direct_with_potential;  ///< three dimensions; the potential goes to a fourth array

  /// The whole field of at most few_points charges by Newton's third law.
  using Mutual = void (*)(const double* const* r, const double* q, int n, double* const* field);
  Mutual mutual_1d, mutual_3d;

  /// The near field of the points of a cell, to arrays in tree order; the potential to a fourth one.
  using Near = void (*)(const CellPoints& target, const CellRange* source, int count, double* const* field);
  Near p2p, p2p_with_potential;

  /// The same in single precision (p2p_single.hpp).
  void (*p2p_single)(const CellPoints& target, const CellRange* source, int count, const NearUnits& unit,
                     double* const* field);

  /// The largest distance of points from a centre.
  double (*reach)(const CellPoints&, const double* centre);

  /// The operators of multipole.hpp on cells (expansions.hpp).
  void (*p2m)(const Expansions&, int cell, const CellPoints&);
  void (*m2m)(const Expansions&, CellRange parents, CellRange children);
  void (*m2l)(const Expansions&, int target, const int* source, int count);
  void (*l2l)(const Expansions&, CellRange parents, CellRange children);
  void (*l2p)(const Expansions&, int cell, const CellPoints&, double* const* sums);
};

/// The kernels of a path that runs here.
const WideKernels& wide_kernels(Isa isa);

extern const WideKernels wide_plain, wide_avx2, wide_avx512;

}  // namespace treejet
