#pragma once
/// A run for a second or so, without files: what a plan (integrators/run/cost_estimate.hpp) is made from.

#include "integrators/run/cost_estimate.hpp"
#include "integrators/run/simulation.hpp"

namespace treejet {

/// Moves the scene on, until the seconds of wall-clock time are over or the deck's final time is reached.
template <int D>
Trial trial_run(const Parameters& p, const typename Simulation<D>::Scene& scene, double seconds);

}  // namespace treejet
