#pragma once
/// What the directives of a deck must be to each other.

#include <string>
#include <vector>

#include "core/directives.hpp"

namespace treejet {

/// One directive as it stands in a deck.
struct Given {
  const Directive* directive;
  std::string where;  ///< "input.dat:12"
  std::vector<std::string> arguments;
  bool valid = false;
};

struct Findings {
  std::vector<std::string> errors;
  std::vector<std::string> notes;
};

/// Relations between directives of which one is faulty or missing are not judged.
void check_relations(const std::string& deck_name, const std::vector<Given>& given,
                     const Parameters& parameters, Findings& findings);

}  // namespace treejet
