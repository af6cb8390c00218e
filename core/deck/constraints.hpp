#pragma once
/// What the directives of a deck must be to each other. Where one is faulty or missing the others are not
/// judged.

#include <vector>

#include "core/deck/findings.hpp"

namespace treejet {

void check_relations(const Place& deck, const std::vector<Given>& given, const Parameters& parameters,
                     Findings& findings);

}  // namespace treejet
