#pragma once
/// Threads: the only way to them. OpenMP tells cores, places and OMP_NUM_THREADS; the team is our own
/// (team.hpp).
///
/// Invariant: a block of rows is computed by exactly one thread, and blocks start at multiples of `block`
/// counted from row 0, whatever the number of threads; a function of rows therefore gives the same bits on
/// any number of threads. The first exception thrown is rethrown to the caller once all threads are done.

#include <bitset>
#include <functional>
#include <optional>

#include "parallel/rows.hpp"

namespace treejet {

struct Threads {
  int count = 1;
};

/// Calls f on whole blocks that cover `rows`, one contiguous share a thread.
void for_each_block_threaded(Threads threads, Rows rows, int block, const std::function<void(Rows)>& f);

/// Calls f on blocks that cover `rows`; with one thread a single call f(rows).
template <class F>
void for_each_block(Threads threads, Rows rows, int block, const F& f) {
  if (threads.count > 1) return for_each_block_threaded(threads, rows, block, std::cref(f));
  if (rows.size() > 0) f(rows);
}

/// Calls f(0), ..., f(count - 1), each once, a free thread taking the next: for tasks of unequal size that
/// write to places of their own, so that it does not matter which thread takes which.
void for_each_task(Threads threads, int count, const std::function<void(int)>& f);

/// Cores this process may run on (affinity respected): how many, and which.
int available_cores();
using CoreSet = std::bitset<1024>;
CoreSet cores_of_this_process();

/// The number in OMP_NUM_THREADS, if there is one.
std::optional<int> threads_named();

}  // namespace treejet
