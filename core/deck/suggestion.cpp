#include "core/deck/suggestion.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace treejet {

namespace {
constexpr std::size_t shortest_stem = 3;
/// One slip in five letters: with more, words of another meaning are near (ultimate, multirate).
int allowance(std::string_view known) {
  return std::max(known.size() < 4 ? 0 : 1, static_cast<int>(known.size()) / 5);
}
}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // row[j] = distance between the first i letters of a and the first j of b
  std::vector<int> row(b.size() + 1), last(row), last_but_one(row);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one.swap(last);
    last.swap(row);
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

bool resembles(std::string_view word, std::string_view known) {
  if (std::min(word.size(), known.size()) >= shortest_stem &&
      (known.starts_with(word) || word.starts_with(known) || word.ends_with(known)))
    return true;
  const auto difference = static_cast<long>(word.size()) - static_cast<long>(known.size());
  return std::abs(difference) <= allowance(known) && edit_distance(word, known) <= allowance(known);
}

}  // namespace treejet
