#pragma once
/// Numbers without a unit that are absurd in the unit they are taken in, and the unit that was likely meant:
/// 839 as g/cm^3, 9000 as statV. Only a note comes of it: what is absurd for us may be what someone studies.

#include <string>

#include "core/deck/directives.hpp"

namespace treejet {

/// Empty if the bare number is one that fluids and laboratories have.
std::string likely_slip(const Directive& directive, double number, Units units);

}  // namespace treejet
