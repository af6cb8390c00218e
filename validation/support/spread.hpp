#pragma once
/// What many turns of a measurement come to.

#include <algorithm>
#include <vector>

namespace treejet {

/// Least, median and greatest of some values.
struct Spread {
  double least, median, most;
  explicit Spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    least = values.front(), median = values[(values.size() - 1) / 2], most = values.back();
  }
};

}  // namespace treejet
