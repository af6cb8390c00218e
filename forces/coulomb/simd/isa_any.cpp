// Processors without hand-chosen instruction sets: the plain path alone, in the compiler's own vectors.
#include "forces/coulomb/simd/kernels.hpp"

namespace treejet {

bool runs_here(Isa isa) {
  return isa == Isa::plain;
}

const WideKernels& wide_kernels(Isa) {
  return wide_plain;
}

}  // namespace treejet
