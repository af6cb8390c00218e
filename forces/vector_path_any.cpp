// Processors without hand-chosen instruction sets: the plain path alone, in the compiler's own vectors.
#include "forces/wide_kernels.hpp"

namespace treejet {

bool runs_here(VectorPath path) {
  return path == VectorPath::plain;
}

const WideKernels& wide_kernels(VectorPath) {
  return wide_plain;
}

}  // namespace treejet
