#include "parallel/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>

namespace treejet {

void for_each_block(Threads threads, Rows rows, int block, const std::function<void(Rows)>& f) {
  if (rows.size() <= 0) return;
  const int first_block = rows.first / block, last_block = (rows.last - 1) / block;
  if (threads.count <= 1 || first_block == last_block) return f(rows);

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

void for_each_task(Threads threads, int count, const std::function<void(int)>& f) {
  if (threads.count <= 1 || count <= 1) {
    for (int k = 0; k < count; ++k) f(k);
    return;
  }
  std::exception_ptr failure;
  std::atomic_flag failed = ATOMIC_FLAG_INIT;
#pragma omp parallel for num_threads(threads.count) schedule(dynamic, 1)
  for (int k = 0; k < count; ++k) {
    try {
      f(k);
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
