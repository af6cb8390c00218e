#pragma once
/// What an evaluation of the field did: pairs of points summed directly, and expansions evaluated (M2L, or
/// M2P with Barnes-Hut).

#include <cstdint>
#include <vector>

namespace treejet {

struct Interactions {
  std::int64_t pairs = 0, expansions = 0;

  Interactions& operator+=(const Interactions& more) {
    pairs += more.pairs;
    expansions += more.expansions;
    return *this;
  }
};

inline Interactions total(const std::vector<Interactions>& parts) {
  Interactions all;
  for (const Interactions& part : parts) all += part;
  return all;
}

}  // namespace treejet
