#pragma once
/// Marks a function whose loops over beads are compiled for several instruction sets; the widest one that
/// runs here is taken when the program is loaded.
///
/// The iterations of such a loop are independent and products and sums are rounded one by one (CMakeLists.txt
/// forbids contraction), so the results have the same bits on every processor. The resolver behind it runs
/// before the thread sanitizer is ready, hence the exception.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define TREEJET_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define TREEJET_SIMD_CLONES
#endif
