// The wide kernels for AVX2 with FMA, compiled for it alone: see kernels.hpp before adding an include.
#include <immintrin.h>

#include "forces/coulomb/simd/expansions.hpp"
#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/simd/p2p.hpp"
#include "forces/coulomb/simd/p2p_single.hpp"

namespace treejet {
namespace {

struct Avx2 {
  static constexpr int lanes = 4, groups = 2;
  using Pack = Wide<double, lanes>;

  /// q d2^(-3/2) from a float start of 12 bits and the series of (1 - e)^(-3/2) to e^4, as in
  /// avx512.cpp. A d2 outside the range of float gives a start of 0 or infinity: such rare pairs are
  /// divided out instead.
  static Pack over_cube(double q, Pack d2) {
    const __m128 start = _mm_rsqrt_ps(_mm256_cvtpd_ps(d2));
    const __m128 usable = _mm_cmplt_ps(_mm_sub_ps(start, start), start);
    if (__builtin_expect(_mm_movemask_ps(usable) != 15, 0)) return q / (d2 * _mm256_sqrt_pd(d2));
    const Pack y = _mm256_cvtps_pd(start), y2 = y * y;
    const Pack e = 1 - d2 * y2;
    return (q * y) * y2 * (1 + e * (3. / 2 + e * (15. / 8 + e * (35. / 16 + e * (315. / 128)))));
  }

  /// The same in single precision.
  static Wide<float, 8> over_cube(float q, Wide<float, 8> d2) {
    const Wide<float, 8> y = _mm256_rsqrt_ps(d2), y2 = y * y;
    const Wide<float, 8> e = 1.0f - d2 * y2;
    return (q * y) * y2 * (1.0f + e * (1.5f + e * 1.875f));
  }

  static Pack over_root(Pack x) { return 1 / _mm256_sqrt_pd(x); }

  /// The values p[k] for `lanes` places k.
  static Pack pick(const double* p, const int* k) { return Pack{p[k[0]], p[k[1]], p[k[2]], p[k[3]]}; }

  /// Row l, lane k becomes row k, lane l.
  static void transpose(Pack (&row)[4]) {
    const Pack a = _mm256_unpacklo_pd(row[0], row[1]), b = _mm256_unpackhi_pd(row[0], row[1]);
    const Pack c = _mm256_unpacklo_pd(row[2], row[3]), d = _mm256_unpackhi_pd(row[2], row[3]);
    row[0] = _mm256_permute2f128_pd(a, c, 0x20);
    row[1] = _mm256_permute2f128_pd(b, d, 0x20);
    row[2] = _mm256_permute2f128_pd(a, c, 0x31);
    row[3] = _mm256_permute2f128_pd(b, d, 0x31);
  }
};

}  // namespace

const WideKernels wide_avx2 = {direct<Avx2, 1>,
                               direct<Avx2, 3>,
                               direct<Avx2, 3, true>,
                               direct_mutual<Avx2, 1>,
                               direct_mutual<Avx2, 3>,
                               p2p<Avx2>,
                               p2p<Avx2, true>,
                               p2p_single<Avx2>,
                               ExpansionKernel<Avx2>::reach,
                               ExpansionKernel<Avx2>::p2m,
                               ExpansionKernel<Avx2>::m2m,
                               ExpansionKernel<Avx2>::m2l,
                               ExpansionKernel<Avx2>::l2l,
                               ExpansionKernel<Avx2>::l2p};

}  // namespace treejet
