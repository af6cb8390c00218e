#pragma once
/// Which directive a line means: whole words, the longest spelling wins, no abbreviations.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/deck/directives.hpp"
#include "core/deck/foreign.hpp"

namespace treejet {

/// One way to spell a directive; both pointers are null for `finish`.
struct Spelling {
  std::string_view text;
  std::size_t words;  ///< how many words of the line it takes
  const Directive* directive = nullptr;
  const Foreign* foreign = nullptr;
};

/// The longest spelling the line begins with, null if there is none.
const Spelling* spelling_at_start(std::span<const std::string> line);

/// The longest spelling of a directive of ours the line begins with, null if there is none.
const Spelling* directive_at_start(std::span<const std::string> line);

/// The spelling of more than `words` words that the line's beginning resembles most, null if there is none.
const Spelling* nearest_spelling(std::span<const std::string> line, std::size_t words = 0);

/// The directives whose first word is this one.
std::vector<std::string_view> directives_beginning_with(std::string_view word);

}  // namespace treejet
