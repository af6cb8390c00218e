#include "parallel/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>

namespace treejet {

void for_each_block_threaded(Threads threads, Rows rows, int block, const std::function<void(Rows)>& f) {
  if (rows.size() <= 0) return;
  const int first_block = rows.first / block, last_block = (rows.last - 1) / block;
  if (first_block == last_block) return f(rows);

  std::exception_ptr failure;
  std::atomic_flag failed = ATOMIC_FLAG_INIT;
#pragma omp parallel for num_threads(threads.count) schedule(static)
  for (int b = first_block; b <= last_block; ++b) {
    try {
      f({std::max(rows.first, b * block), std::min(rows.last, (b + 1) * block)});
    } catch (...) {
      if (!failed.test_and_set()) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

int available_cores() {
  return omp_get_num_procs();
}

}  // namespace treejet
