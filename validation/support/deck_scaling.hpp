#pragma once
/// What is asked of the scaling of a deck, and the teams of workers that follow from it.

#include <string>
#include <vector>

#include "validation/support/rank_layout.hpp"

namespace treejet {

struct DeckScaling {
  std::string deck;
  std::vector<std::string> overrides = {};
  std::string from = {};  ///< directory of a run whose state is the beginning
  std::vector<int> workers = {}, ranks = {}, threads = {};
  std::string data = "both";  ///< replicated, distributed
  std::int64_t steps = 0;     ///< of each run; 0: as many as one worker takes in `seconds`
  double seconds = 10;
  int turns = 3;
};

/// InputError or FileError unless the deck, the state that it begins with and the data asked for are such as
/// can be run.
void require_valid(const DeckScaling& asked);

/// Why the deck is not run with subdomains, the reader's words; empty if it is.
std::string undistributable(const DeckScaling& asked);

/// A team, and whether its ranks hold a subdomain of the chain each or all of it. Copies are no team but as
/// many serial programs at the same time, which share the machine and nothing else: no team need be asked for
/// a better efficiency than theirs.
struct Workers {
  RankLayout layout;
  bool subdomains = false, copies = false;

  /// "serial", "threads", "ranks", "mixed", "distributed", "copies".
  std::string name() const;
};

/// The serial program first, each team once. Of `workers` each number by threads, by ranks and, where there
/// are so many cores, by copies; of `ranks` and `threads` all products; of none of them the powers of 2 up to
/// the cores. InputError for ranks where there is no MPI. `distributable`: subdomains are possible.
std::vector<Workers> teams(const DeckScaling& asked, int cores, bool distributable);

}  // namespace treejet
