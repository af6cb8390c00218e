// The wide kernels for any processor, in registers of two doubles (SSE2, NEON, ...).
#include "forces/coulomb/simd/expansions.hpp"
#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/simd/p2p.hpp"
#include "forces/coulomb/simd/p2p_single.hpp"

namespace treejet {
namespace {

struct Plain {
  static constexpr int lanes = 2, groups = 2;
  using Pack = Wide<double, lanes>;

  static Pack over_cube(double q, Pack d2) { return q / (d2 * root(d2)); }

  static Wide<float, 4> over_cube(float q, Wide<float, 4> d2) {
    Wide<float, 4> cube;
    for (int l = 0; l < 4; ++l) cube[l] = d2[l] * __builtin_sqrtf(d2[l]);
    return q / cube;
  }

  static Pack over_root(Pack x) { return 1 / root(x); }

  static Pack root(Pack x) { return Pack{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])}; }

  /// The values p[k] for `lanes` places k.
  static Pack pick(const double* p, const int* k) { return Pack{p[k[0]], p[k[1]]}; }

  /// Row l, lane k becomes row k, lane l.
  static void transpose(Pack (&row)[2]) {
    const Pack first = {row[0][0], row[1][0]}, second = {row[0][1], row[1][1]};
    row[0] = first;
    row[1] = second;
  }
};

}  // namespace

const WideKernels wide_plain = {direct<Plain, 1>,
                                direct<Plain, 3>,
                                direct<Plain, 3, true>,
                                direct_mutual<Plain, 1>,
                                direct_mutual<Plain, 3>,
                                p2p<Plain>,
                                p2p<Plain, true>,
                                p2p_single<Plain>,
                                ExpansionKernel<Plain>::reach,
                                ExpansionKernel<Plain>::p2m,
                                ExpansionKernel<Plain>::m2m,
                                ExpansionKernel<Plain>::m2l,
                                ExpansionKernel<Plain>::l2l,
                                ExpansionKernel<Plain>::l2p};

}  // namespace treejet
