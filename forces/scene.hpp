#pragma once
/// A scene: what a deck's parameters compose, ready to move. Only the terms that the deck names are in it;
/// for each one left out, `left_out` tells why.

#include <string>
#include <vector>

#include "core/collector.hpp"
#include "core/nozzle.hpp"
#include "core/parameters.hpp"
#include "forces/equations_of_motion.hpp"

namespace treejet {

struct Choice {
  std::string term, reason;
};

template <int D>
struct Scene {
  Jet<D> jet;  ///< the initial jet
  Nozzle<D> nozzle;
  Collector collector;
  std::unique_ptr<EquationsOfMotion<D>> motion;
  std::vector<Choice> composed, left_out;
};

template <int D>
Scene<D> compose(const Parameters& parameters, Threads threads);

}  // namespace treejet
