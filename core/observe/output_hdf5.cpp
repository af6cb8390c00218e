#include "core/observe/output_hdf5.hpp"

#include <algorithm>

namespace treejet {

std::vector<std::string> reproducible_keys(const std::vector<std::string>& keys) {
  std::vector<std::string> kept;
  for (const auto& key : keys) {
    const bool wall_clock = key.starts_with("cpu");
    if (!wall_clock && std::find(kept.begin(), kept.end(), key) == kept.end()) kept.push_back(key);
  }
  return kept;
}

}  // namespace treejet
