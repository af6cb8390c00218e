#pragma once
/// A deck: the text file that describes a run, one directive a line, in CGS.
///
/// Grammar: free form, case-insensitive; words are separated by blanks and tabs; a comment goes from # or !
/// to the end of the line; line ends of any system; `finish` is the last line. Directives are spelled out in
/// full, come in any order and appear once. An override ("viscosity 30.") is one more line that replaces the
/// deck's line of the same directive (or of the one it excludes: tolerance for timestep, points for
/// resolution, flow rate for nozzle velocity), or adds one. All errors of a deck are reported together in one
/// InputError, one a line: `file:line: directive: what was expected, what was found; did you mean ...?`. A
/// file that cannot be read is a FileError. Source: paper, Sec. "Description of input file" and Appendix A;
/// the directives are the table of core/deck/directives.cpp.

#include <string>
#include <string_view>
#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

struct Deck {
  Parameters parameters;
  std::string text;  ///< the source, in UTF-8
  std::string name;  ///< of the file
  std::vector<std::string> overrides;
  std::vector<std::string> notes;  ///< what is legal but has no effect
};

Deck read_deck(const std::string& path, const std::vector<std::string>& overrides = {});
Deck parse_deck(std::string_view text, std::string name, std::vector<std::string> overrides = {});

/// The deck with more overrides, each in the place of an earlier one of the same directive.
Deck changed(const Deck& deck, const std::vector<std::string>& overrides);

/// The notes, one a line, as the terminal shows them.
std::string notes(const Deck& deck);

/// A complete, commented deck, ready to run.
std::string deck_template();

/// Tables of the documentation, in Markdown: all directives, and JETSPIN's that are not modelled; all keys.
std::string directive_reference();
std::string key_reference();

}  // namespace treejet
