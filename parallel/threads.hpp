#pragma once
/// Threads: the only `omp parallel` of the project.
///
/// Invariant: a block of rows is computed by exactly one thread, and blocks start at multiples of `block`
/// counted from row 0, whatever the number of threads; a function of rows therefore gives the same bits on
/// any number of threads. The first exception thrown in a block is rethrown to the caller once all threads
/// are done.

#include <functional>

#include "parallel/rows.hpp"

namespace treejet {

struct Threads {
  int count = 1;
};

/// Calls f on blocks that cover `rows`; with one thread a single call f(rows).
void for_each_block(Threads threads, Rows rows, int block, const std::function<void(Rows)>& f);

/// Cores this process may run on (affinity respected).
int available_cores();

}  // namespace treejet
