#pragma once
/// What decks of JETSPIN (1.00 to 2.0 beta) say that Treejet does not model, by feature.
///
/// A feature is reported in one line, however many lines of the deck are about it: as an error with what to
/// do instead, or as a note where leaving it out changes nothing of the physics. That is so where the deck
/// switches the feature off (`evaporation no`, then its other lines, too) and where only files are concerned.

#include <span>
#include <string>
#include <string_view>

namespace treejet {

struct Foreign {
  std::string_view words;
  std::string_view feature;
  std::string_view advice;    ///< of an error; a note says "left out" and this
  std::string_view off = {};  ///< value that switches the feature off, or leaves it as Treejet does it
  bool harmless = false;      ///< no line of it concerns the physics
  bool since_1_21 = false;    ///< earlier versions do not know it
};

std::span<const Foreign> foreign_directives();

/// A key of JETSPIN's tables that Treejet does not have: left out with a note. Empty feature if there is
/// none.
struct ForeignKey {
  std::string_view key;
  std::string_view feature;
};

std::span<const ForeignKey> foreign_keys();

}  // namespace treejet
