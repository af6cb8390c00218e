#pragma once
/// The inner loops that exist once per instruction set, as a table of functions.
///
/// Each path is one translation unit (wide_plain.cpp, wide_avx2.cpp, wide_avx512.cpp) compiled for its
/// instruction set. Such a unit must not emit any function another unit could be linked to, or a narrow
/// machine would meet wide code: hence plain pointers in these signatures, and everything behind the table
/// has internal linkage.

#include "forces/vector_path.hpp"
#include "parallel/rows.hpp"

namespace treejet {

struct WideKernels {
  /// Rows of the field of n charges at D coordinate arrays (coulomb.hpp).
  using Direct = void (*)(const double* const* r, const double* q, int n, Rows rows, double* const* field);
  Direct direct_1d, direct_3d;
};

/// The kernels of a path that runs here.
const WideKernels& wide_kernels(VectorPath path);

extern const WideKernels wide_plain, wide_avx2, wide_avx512;

}  // namespace treejet
