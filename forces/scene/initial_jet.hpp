#pragma once
/// The jet at the beginning of a run: straight, in equal elements, moving as it leaves the nozzle. Scaled.

#include <vector>

#include "core/jet/columns.hpp"
#include "core/jet/jet.hpp"
#include "core/jet/parameters.hpp"

namespace treejet {

/// Beads at x_i = initial length - i l_step, at the nozzle velocity and stress: those with these numbers.
template <int D>
Jet<D> initial_jet(const Parameters& parameters, const std::vector<int>& beads, const Columns& added);

/// The numbers of all of them.
std::vector<int> initial_beads(const Parameters& parameters);

}  // namespace treejet
