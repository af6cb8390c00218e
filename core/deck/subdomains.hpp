#pragma once
/// Which jets ranks can hold in subdomains (`parallel distributed`), and when `parallel auto` lets them.
///
/// Replicated, every rank builds the tree of the whole jet and moves all beads, and only the sum is shared
/// out; in subdomains all is, at the price of a few rounds of messages an evaluation, which weigh the more
/// the fewer beads a rank has and the slower the network is. Measured in docs/accuracy.md.

#include <string>
#include <string_view>
#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

/// From this number of beads a rank on `parallel auto` takes subdomains.
constexpr int beads_worth_a_subdomain = 5000;

struct Obstacle {
  std::vector<std::string_view> directives;
  std::string message;  ///< what is expected instead
};

/// Why the jet of these parameters cannot be held in subdomains.
std::vector<Obstacle> obstacles_to_subdomains(const Parameters& p);

/// What the parameters say; of `parallel auto` what it takes on so many ranks.
ParallelData data_of_ranks(const Parameters& p, int ranks);

}  // namespace treejet
