// The wide kernels for AVX-512 (F, DQ, VL), compiled for it alone: see wide_kernels.hpp before adding an
// include.
#include <immintrin.h>

#include "forces/direct_kernel.hpp"
#include "forces/wide_kernels.hpp"

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
};

}  // namespace

const WideKernels wide_avx512 = {direct<Avx512, 1>, direct<Avx512, 3>};

}  // namespace treejet
