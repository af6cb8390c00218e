#include "core/base/freed_memory.hpp"

#include <malloc.h>

namespace treejet {

void keep_freed_memory() {
#ifdef M_MMAP_MAX
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

}  // namespace treejet
