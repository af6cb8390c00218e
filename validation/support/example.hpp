#pragma once
/// The decks in examples/: the paper's cases 1, 2 and 3 are single-bead, straight-jet and pvp.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/deck/deck.hpp"
#include "validation/support/installation.hpp"

namespace treejet {

/// The parameters of examples/NAME/input.dat with some of its directives replaced.
inline Parameters example(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_deck(fmt::format("{}/examples/{}/input.dat", source_tree(), name), overrides).parameters;
}

}  // namespace treejet
