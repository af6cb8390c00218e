#pragma once
/// What a deck gives and what is found wrong with it: the notes the reader of a deck takes.

#include <algorithm>
#include <string>
#include <vector>

#include "core/deck/directives.hpp"

namespace treejet {

/// What a message is about: a line, an override, or, last of all, the deck as a whole.
struct Place {
  std::string name;  ///< "input.dat:12"
  int order;
};

struct Finding {
  Place place;
  std::string message;
};

struct Findings {
  std::vector<Finding> errors, notes;
};

/// One directive as it stands in a deck.
struct Given {
  const Directive* directive;
  Place place;
  std::vector<std::string> arguments = {};
  bool faulty = false;  ///< misspelt or with a bad value: reported, and not to be judged further
};

/// The lines of a deck about one feature of JETSPIN's that is not modelled.
struct ForeignLines {
  std::string_view feature, advice;
  Place first;
  std::string first_line;
  int count = 0;
  bool off = false, harmless = true;
};

/// The first that gives the directive, null if none does.
inline const Given* find(const std::vector<Given>& given, const Directive& directive) {
  const auto found =
      std::find_if(given.begin(), given.end(), [&](const Given& g) { return g.directive == &directive; });
  return found == given.end() ? nullptr : &*found;
}

}  // namespace treejet
