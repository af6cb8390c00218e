#include "core/observe/output_hdf5.hpp"

#include <algorithm>

#include "core/deck/observable_keys.hpp"

namespace treejet {

std::vector<std::string> reproducible_keys(const std::vector<std::string>& keys) {
  std::vector<std::string> kept;
  for (const auto& key : keys) {
    if (!has(key, wall_clock) && std::find(kept.begin(), kept.end(), key) == kept.end()) kept.push_back(key);
  }
  return kept;
}

}  // namespace treejet
