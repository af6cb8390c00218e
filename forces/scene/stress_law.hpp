#pragma once
/// The stress law that a deck names (core/jet/stiffness.hpp tells which), with its constants, scaled.

#include <memory>

#include "core/jet/parameters.hpp"
#include "forces/terms/constitutive.hpp"

namespace treejet {

template <int D>
std::unique_ptr<StressLaw<D>> stress_law_of(const Parameters& parameters);

/// Whether it is Maxwell's with a yield stress or a power of the rate as JETSPIN has them, rounded at small
/// rates.
bool is_jetspin_herschel_bulkley(const Parameters& parameters);

}  // namespace treejet
