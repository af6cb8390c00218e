#pragma once
/// A stopped run as it is taken up again: its newest sound checkpoint, and the deck that is in it.

#include "core/deck/deck.hpp"
#include "core/restart/checkpoint.hpp"

namespace treejet {

struct Resumption {
  Checkpoint checkpoint;
  Deck deck;
  std::vector<std::string> warnings;  ///< about checkpoints passed over, or made by another program
};

/// FileError without a sound checkpoint; InputError if it is of other physics than the program has.
Resumption resumption(const std::filesystem::path& directory, const std::string& program,
                      const Readers& readers = {});

/// InputError that names the directives in which a deck differs from that of the checkpoint.
void expect_same(const Deck& given, const Deck& in_checkpoint);

}  // namespace treejet
