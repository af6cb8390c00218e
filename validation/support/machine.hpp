#pragma once
/// What a study of speed needs to know of the machine it runs on.

#include <string>
#include <vector>

#include "parallel/ranks.hpp"

namespace treejet {

/// The cores this process may run on, of each the number of its first thread.
std::vector<int> cores_apart();

/// How many they are; at least one, should nothing tell.
int physical_cores();

/// "Intel(R) Xeon(R) Processor", or "unknown".
std::string processor_name();

/// The most memory that this process ever had.
double peak_bytes();

/// First and last core of each rank, "0-1,2-3". Called by all ranks.
std::string cores_of(const Ranks& ranks);

/// What the processors have done since an instant.
class ProcessorUse {
 public:
  ProcessorUse();
  /// The share of their time since then that went to others than this process and its ended children: other
  /// processes, or the host of a virtual machine.
  double by_others() const;

 private:
  double all_, busy_, own_;  ///< s
};

}  // namespace treejet
