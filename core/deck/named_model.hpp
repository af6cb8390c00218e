#pragma once
/// Models: several directives in one line. Lines of the deck that say otherwise are errors.

#include <vector>

#include "core/deck/findings.hpp"

namespace treejet {

/// Sets what `model slender` stands for; `model paper` leaves it to the lines themselves.
void apply_model(const std::vector<Given>& given, Parameters& parameters, Findings& findings);

}  // namespace treejet
