#include "parallel/threads.hpp"

#include <omp.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <vector>

#include "parallel/team.hpp"

namespace treejet {

namespace {

/// Where OpenMP's variables bind threads to places, a thread goes to the place that one of OpenMP's own
/// would.
void bind_to_place(int number) {
  const int places = omp_get_num_places();
  if (places == 0 || omp_get_proc_bind() == omp_proc_bind_false) return;
  const bool spread = omp_get_proc_bind() == omp_proc_bind_spread;
  const int threads = omp_get_max_threads();
  const int place = (spread && threads < places ? number * places / threads : number) % places;
  std::vector<int> cores(static_cast<std::size_t>(omp_get_place_num_procs(place)));
  omp_get_place_proc_ids(place, cores.data());
  cpu_set_t mask;
  CPU_ZERO(&mask);
  for (int core : cores) CPU_SET(static_cast<std::size_t>(core), &mask);
  sched_setaffinity(0, sizeof mask, &mask);
}

Team& team() {
  static Team all(bind_to_place);
  return all;
}

}  // namespace

void for_each_task(Threads threads, int count, const std::function<void(int)>& f) {
  if (threads.count <= 1 || count <= 1) {
    for (int k = 0; k < count; ++k) f(k);
    return;
  }
  std::exception_ptr failure;
  std::atomic_flag failed = ATOMIC_FLAG_INIT;
  team().run(threads.count, count, [&](int k) {
    try {
      f(k);
    } catch (...) {
      if (!failed.test_and_set()) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

void for_each_block_threaded(Threads threads, Rows rows, int block, const std::function<void(Rows)>& f) {
  if (rows.size() <= 0) return;
  const int first = rows.first / block, blocks = (rows.last - 1) / block + 1 - first;
  const int shares = std::min(threads.count, blocks);
  const auto border = [&](int k) {
    return (first + static_cast<int>(std::int64_t{blocks} * k / shares)) * block;
  };
  for_each_task(threads, shares, [&](int k) {
    f({std::max(rows.first, border(k)), std::min(rows.last, border(k + 1))});
  });
}

int available_cores() {
  return omp_get_num_procs();
}

CoreSet cores_of_this_process() {
  CoreSet cores;
  // where OpenMP has bound this thread to one of its places, its own mask shows that place only
  for (int place = 0; place < omp_get_num_places(); ++place) {
    std::vector<int> ids(static_cast<std::size_t>(omp_get_place_num_procs(place)));
    omp_get_place_proc_ids(place, ids.data());
    for (int id : ids) cores.set(static_cast<std::size_t>(id) % cores.size());
  }
  cpu_set_t mask;
  if (cores.any() || sched_getaffinity(0, sizeof mask, &mask) != 0) return cores;
  for (std::size_t id = 0; id < CPU_SETSIZE; ++id) cores[id] = CPU_ISSET(id, &mask);
  return cores;
}

std::optional<int> threads_named() {
  if (!std::getenv("OMP_NUM_THREADS")) return std::nullopt;
  return omp_get_max_threads();
}

}  // namespace treejet
