#pragma once
/// A contiguous share of the rows of a table, first <= row < last.

namespace treejet {

struct Rows {
  int first = 0, last = 0;
  int size() const { return last - first; }
};

}  // namespace treejet
