// The paths of x86-64 processors; CMake takes isa_any.cpp elsewhere.
#include "forces/coulomb/simd/kernels.hpp"

namespace treejet {

bool runs_here(Isa isa) {
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  switch (isa) {
    case Isa::avx512:
      return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
    case Isa::avx2:
      return avx2;
    default:
      return true;
  }
}

const WideKernels& wide_kernels(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return wide_avx512;
    case Isa::avx2:
      return wide_avx2;
    default:
      return wide_plain;
  }
}

}  // namespace treejet
