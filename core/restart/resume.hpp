#pragma once
/// A run as it is taken up again: its newest sound checkpoint, and the deck that is in it; stopped, to go on
/// to its end, or at its end or stopped, to go on to a later one.
///
/// The later end leaves the same bytes as a run that had it from the start, but for what tells the deck. So
/// nothing may change with it but the final time and how often checkpoints are written: InputError for any
/// other directive, for tables whose interval is a hundredth of the final time because the deck has no print
/// time, and for a final time so short that it decided on the scheme.

#include "core/deck/deck.hpp"
#include "core/restart/checkpoint.hpp"

namespace treejet {

struct Resumption {
  Checkpoint checkpoint;
  Deck deck;                          ///< the one to go on with
  bool extended = false;              ///< it differs from that of the checkpoint
  std::vector<std::string> warnings;  ///< about checkpoints passed over, or made by another program
};

/// FileError without a sound checkpoint; InputError if it is of other physics than the program has, or if the
/// overrides change what they may not.
Resumption resumption(const std::filesystem::path& directory, const std::string& program,
                      const std::vector<std::string>& overrides = {}, const Readers& readers = {});

/// InputError that names the directives in which a deck differs from that of the checkpoint.
void expect_same(const Deck& given, const Deck& in_checkpoint);

}  // namespace treejet
