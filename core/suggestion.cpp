#include "core/suggestion.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace treejet {

namespace {
int allowance(std::string_view known) {
  return (static_cast<int>(known.size()) + 1) / 3;
}
}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // row[j] = distance between the first i letters of a and the first j of b
  std::vector<int> row(b.size() + 1), last(b.size() + 1), last_but_one;
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one = last;
    last = row;
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replacement = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replacement, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], last_but_one[j - 2] + 1);
    }
  }
  return row[b.size()];
}

bool resembles(std::string_view a, std::string_view b) {
  const auto difference = static_cast<long>(a.size()) - static_cast<long>(b.size());
  return std::abs(difference) <= allowance(b) && edit_distance(a, b) <= allowance(b);
}

}  // namespace treejet
