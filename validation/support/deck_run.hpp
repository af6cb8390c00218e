#pragma once
/// One measured stretch of a run of any deck, in a process (or rank) of its own: as `treejet run` makes it,
/// with its outputs and a checkpoint at the end, for a number of steps after a warm-up.

#include <string>
#include <vector>

#include "core/deck/deck.hpp"
#include "parallel/ranks.hpp"
#include "parallel/work_clock.hpp"

namespace treejet {

struct DeckRun {
  std::string deck;
  std::vector<std::string> overrides = {};
  std::string from = {};  ///< the state of another run (core/restart/origin.hpp); empty: the initial jet
  std::string directory;  ///< for its files, which take the place of any there
  int threads = 1;
  bool subdomains = false;  ///< parallel distributed; else replicated, whatever the deck says
  std::int64_t steps = 1'000'000'000;
  double seconds = 1e9;  ///< no step begins later; of one rank only
};

/// Means over the ranks, where nothing else is said.
struct DeckMeasurement {
  std::int64_t beads = 0;  ///< at the end
  std::int64_t steps = 0, evaluations = 0;
  double seconds = 0;  ///< of all these steps
  WorkSeconds work{};
  double busiest = 0;     ///< seconds of the rank that exchanges least, exchange left out
  double checkpoint = 0;  ///< s, for writing it
  double memory = 0;      ///< bytes: the most that any rank's process ever had
  double t = 0, x = 0;    ///< s, cm: at the end, where the oldest bead is
  std::string bits;       ///< a hash of the last state
  std::string cores;      ///< of each rank, "0-1,2-3"
  std::string sum;        ///< how the Coulomb field is made, "-" where it has no choice
};

/// The deck as it is run, without an end. InputError if it cannot be.
Deck deck_of(const DeckRun& run);

/// InputError if the run ends before there was a step to measure.
DeckMeasurement measure(const DeckRun& run, const Ranks& ranks);

/// One line, and back.
std::string text(const DeckMeasurement& m);
DeckMeasurement deck_measurement(const std::string& text);

}  // namespace treejet
