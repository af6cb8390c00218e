#pragma once
/// The known word a user most likely meant.

#include <string_view>

namespace treejet {

/// Least number of insertions, deletions, replacements and swaps of neighbours that turn a into b.
int edit_distance(std::string_view a, std::string_view b);

/// Is the word so near to the known one, or its beginning, or with more around it, that one may ask "did you
/// mean"?
bool resembles(std::string_view word, std::string_view known);

/// The nearest of the known words (anything iterable as string_view), empty if none resembles the word.
template <class Words>
std::string_view nearest(std::string_view word, const Words& known) {
  std::string_view best;
  int least = 0;
  for (const std::string_view candidate : known) {
    if (!resembles(word, candidate)) continue;
    const int distance = edit_distance(word, candidate);
    if (best.empty() || distance < least) best = candidate, least = distance;
  }
  return best;
}

}  // namespace treejet
