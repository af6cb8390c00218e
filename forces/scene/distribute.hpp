#pragma once
/// A scene in subdomains, one a rank: who holds which beads, and the motion that sees beyond its own.

#include <functional>
#include <vector>

#include "forces/scene/scene.hpp"

namespace treejet {

/// The beads of these rows of the whole initial jet.
using JetOfRows = std::function<Jet<3>(const std::vector<int>&)>;

/// Puts the motion of a jet of so many beads in subdomains on top of the local terms of `scene`, and gives
/// this rank its part of the jet.
void distribute(Scene<3>& scene, const Parameters& parameters, int beads, const JetOfRows& jet_of,
                Threads threads, const Ranks& ranks, bool two_rates = false);

}  // namespace treejet
