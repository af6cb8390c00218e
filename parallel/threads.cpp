#include "parallel/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace treejet {

namespace {

/// GCC's OpenMP library is not instrumented, so the thread sanitizer sees neither its fork nor its join and
/// would report every region. These two tell it: what happened before `hand_over(x)` is visible after
/// `take_over(x)`. The region's own bookkeeping lies outside of them, hence `no_sanitize_thread` below; all
/// that f does is watched.
#ifdef __SANITIZE_THREAD__
void hand_over(void* x) {
  __tsan_release(x);
}
void take_over(void* x) {
  __tsan_acquire(x);
}
#else
void hand_over(void*) {}
void take_over(void*) {}
#endif

}  // namespace

[[gnu::no_sanitize_thread]] void for_each_block_threaded(Threads threads, Rows rows, int block,
                                                         const std::function<void(Rows)>& f) {
  if (rows.size() <= 0) return;
  const int first_block = rows.first / block, last_block = (rows.last - 1) / block;
  if (first_block == last_block) return f(rows);

  std::exception_ptr failure;
  std::atomic_flag failed = ATOMIC_FLAG_INIT;
  char fork, join;
  hand_over(&fork);
#pragma omp parallel for num_threads(threads.count) schedule(static)
  for (int b = first_block; b <= last_block; ++b) {
    take_over(&fork);
    try {
      f({std::max(rows.first, b * block), std::min(rows.last, (b + 1) * block)});
    } catch (...) {
      if (!failed.test_and_set()) failure = std::current_exception();
    }
    hand_over(&join);
  }
  take_over(&join);
  if (failure) std::rethrow_exception(failure);
}

int available_cores() {
  return omp_get_num_procs();
}

}  // namespace treejet
