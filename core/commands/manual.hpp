#pragma once
/// What `treejet reference` prints for others than people: the pages of `man`, and completion for bash. All
/// of it is read off the command line's own tables and those of decks.

#include <string>
#include <vector>

namespace treejet {

struct OptionHelp {
  std::string name, argument, meaning;  ///< "--out", "DIR", ...; a name without dashes is a position
};

struct CommandHelp {
  std::string name, meaning;
  std::vector<OptionHelp> options;
};

/// treejet(1); `lesson` is what the help of the program ends with.
std::string program_manual(const std::vector<CommandHelp>& commands, const std::string& lesson);

/// treejet-deck(5): directives and observables.
std::string deck_manual();

/// A script for bash-completion.
std::string bash_completion(const std::vector<CommandHelp>& commands);

}  // namespace treejet
