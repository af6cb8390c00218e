#pragma once
/// What a study of speed needs to know of the machine it runs on.

#include <string>

#include "parallel/ranks.hpp"

namespace treejet {

/// Of those this process may run on; the threads of a core count as one.
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
