#pragma once
/// A run for a second or so, without files: what a cost estimate (integrators/run/cost_estimate.hpp) is made
/// from.

#include "integrators/run/cost_estimate.hpp"
#include "integrators/run/integration.hpp"

namespace treejet {

/// Moves the system until the seconds of wall-clock time are over or the deck's final time is reached.
template <int D>
Trial trial_run(const Parameters& p, const System<D>& system, double seconds);

}  // namespace treejet
