// The wide kernels for AVX-512 (F, DQ, VL), compiled for it alone: see kernels.hpp before adding an
// include.
#include <immintrin.h>

#include "forces/coulomb/simd/expansions.hpp"
#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/simd/p2p.hpp"
#include "forces/coulomb/simd/p2p_single.hpp"

namespace treejet {
namespace {

struct Avx512 {
  static constexpr int lanes = 8, groups = 2;
  using Pack = Wide<double, lanes>;

  /// q d2^(-3/2): y = d2^(-1/2) to 14 bits, then with e = 1 - d2 y^2, |e| < 2^-13, the series of
  /// (1 - e)^(-3/2) to e^3; what is left out is 315/128 e^4, about one unit of the last place.
  static Pack over_cube(double q, Pack d2) {
    const Pack y = _mm512_maskz_rsqrt14_pd(0xff, d2), y2 = y * y;
    const Pack e = 1 - d2 * y2;
    return (q * y) * y2 * (1 + e * (3. / 2 + e * (15. / 8 + e * (35. / 16))));
  }

  /// The same in single precision: one correction of 14 bits is enough.
  static Wide<float, 16> over_cube(float q, Wide<float, 16> d2) {
    const Wide<float, 16> y = _mm512_maskz_rsqrt14_ps(0xffff, d2), y2 = y * y;
    return (q * y) * y2 * (2.5f - 1.5f * (d2 * y2));
  }

  static Pack over_root(Pack x) {
    const Pack y = _mm512_maskz_rsqrt14_pd(0xff, x);
    const Pack e = 1 - x * y * y;
    return y + y * e * (1. / 2 + e * (3. / 8 + e * (5. / 16)));
  }

  /// The values p[k] for `lanes` places k.
  static Pack pick(const double* p, const int* k) {
    return _mm512_mask_i32gather_pd(Pack{}, 0xff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(k)), p,
                                    8);
  }

  /// Row l, lane k becomes row k, lane l: pairs, then quarters, then halves of registers.
  static void transpose(Pack (&row)[8]) {
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    Pack pair[8], quarter[8];
    for (int l = 0; l < 8; l += 2) {
      pair[l] = _mm512_maskz_unpacklo_pd(0xff, row[l], row[l + 1]);
      pair[l + 1] = _mm512_maskz_unpackhi_pd(0xff, row[l], row[l + 1]);
    }
    for (int l = 0; l < 8; l += 4)
      for (int k = 0; k < 2; ++k) {
        quarter[l + k] = _mm512_permutex2var_pd(pair[l + k], low, pair[l + k + 2]);
        quarter[l + k + 2] = _mm512_permutex2var_pd(pair[l + k], high, pair[l + k + 2]);
      }
    for (int k = 0; k < 4; ++k) {
      row[k] = _mm512_maskz_shuffle_f64x2(0xff, quarter[k], quarter[k + 4], 0x44);
      row[k + 4] = _mm512_maskz_shuffle_f64x2(0xff, quarter[k], quarter[k + 4], 0xee);
    }
  }
};

}  // namespace

const WideKernels wide_avx512 = {direct<Avx512, 1>,
                                 direct<Avx512, 3>,
                                 direct<Avx512, 3, true>,
                                 direct_mutual<Avx512, 1>,
                                 direct_mutual<Avx512, 3>,
                                 p2p<Avx512>,
                                 p2p<Avx512, true>,
                                 p2p_single<Avx512>,
                                 ExpansionKernel<Avx512>::reach,
                                 ExpansionKernel<Avx512>::p2m,
                                 ExpansionKernel<Avx512>::m2m,
                                 ExpansionKernel<Avx512>::m2l,
                                 ExpansionKernel<Avx512>::l2l,
                                 ExpansionKernel<Avx512>::l2p};

}  // namespace treejet
