#pragma once
/// A contiguous share of the rows of a table, first <= row < last.

#include <cstddef>

namespace treejet {

/// Rows, ranks, cells are counted in int; containers want this.
constexpr std::size_t index(int k) {
  return static_cast<std::size_t>(k);
}

struct Rows {
  int first = 0, last = 0;
  int size() const { return last - first; }
};

}  // namespace treejet
