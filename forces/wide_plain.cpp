// The wide kernels for any processor, in registers of two doubles (SSE2, NEON, ...).
#include "forces/direct_kernel.hpp"
#include "forces/wide_kernels.hpp"

namespace treejet {
namespace {

struct Plain {
  static constexpr int lanes = 2, groups = 2;
  using Pack = Wide<double, lanes>;

  static Pack over_cube(double q, Pack d2) {
    const Pack root = {__builtin_sqrt(d2[0]), __builtin_sqrt(d2[1])};
    return q / (d2 * root);
  }
};

}  // namespace

const WideKernels wide_plain = {direct<Plain, 1>, direct<Plain, 3>};

}  // namespace treejet
