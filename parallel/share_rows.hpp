#pragma once
/// A table computed by all ranks and their threads together.

#include "parallel/ranks.hpp"

namespace treejet {

/// Calls f on blocks of this rank's share of `rows`, then gathers what all ranks have set in the columns.
template <class F>
void share_rows(const Ranks& ranks, Threads threads, Rows rows, int block, std::span<double* const> columns,
                const F& f) {
  if (ranks.size() == 1) return for_each_block(threads, rows, block, f);
  const std::vector<int> borders = ranks.borders(rows, block);
  const auto me = static_cast<std::size_t>(ranks.rank());
  for_each_block(threads, {borders[me], borders[me + 1]}, block, f);
  ranks.gather(columns, borders);
}

}  // namespace treejet
