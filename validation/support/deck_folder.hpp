#pragma once
/// A folder of decks, each run for a bounded time: what it needs and what comes of it, or why it is refused.

#include <filesystem>

#include "validation/support/report.hpp"

namespace treejet {

struct DeckFolder {
  std::filesystem::path directory;
  double seconds = 10;      ///< of the processor, for each deck
  bool as_written = false;  ///< by the decks' own time steps, else by tolerance 1e-6
};

/// One row a deck in the order of names: beads, means of the observables over the second half of the time
/// reached, and that time. FileError if the folder has no deck.
void run_decks(const DeckFolder& folder, Report& report);

}  // namespace treejet
