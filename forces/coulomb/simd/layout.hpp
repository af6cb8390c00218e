#pragma once
/// The moments and local series of all cells in memory, as the wide kernels see them: plain pointers, no
/// functions (see kernels.hpp).
///
/// Cell k has its centre at (centre[0][k], centre[1][k], centre[2][k]), its moments (degree order-1) at
/// moments + k moment_stride and its local series (degree order) at locals + k local_stride, both packed as
/// in Series::place and padded to a multiple of 8.

namespace treejet {

struct Expansions {
  int order;
  int moment_stride, local_stride;
  const double* centre[3];
  double* moments;
  double* locals;
  bool potential;  ///< whether local series are made to give the potential as well as the field
};

/// Cells first..last-1, whose parents (or children) of the same level stand together elsewhere.
struct CellRange {
  int first, last;
};

/// The points of one cell in tree order.
struct CellPoints {
  const double* r[3];
  const double* q;
  int first, count;
};

/// What positions and charges are measured in for the near field in single precision.
struct NearUnits {
  double centre[3];
  double length, charge;
};

}  // namespace treejet
