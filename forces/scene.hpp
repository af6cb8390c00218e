#pragma once
/// A scene: what a deck's parameters compose, ready to move. Only the terms that the deck names are in it;
/// for each one left out, `left_out` tells why.

#include <functional>
#include <string>
#include <vector>

#include "core/collector.hpp"
#include "core/force_error.hpp"
#include "core/holding.hpp"
#include "core/nozzle.hpp"
#include "core/parameters.hpp"
#include "forces/equations_of_motion.hpp"
#include "forces/two_rate_motion.hpp"

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
  std::unique_ptr<TwoRateMotion<D>> two_rates;  ///< null where every term is evaluated at every stage
  /// Of a jet held in pieces: who holds what, and its motion. Null where every rank holds all of it.
  std::unique_ptr<Holding<D>> pieces;
  std::unique_ptr<Motion<D>> pieces_motion;
  const ForceError* pieces_error = nullptr;
  std::vector<Choice> composed, left_out;

  /// The right-hand side to step with.
  Motion<D>& right_hand_side() {
    if (pieces_motion) return *pieces_motion;
    if (two_rates) return *two_rates;
    return *motion;
  }

  /// What is measured of approximate forces, null where all are exact.
  const ForceError* force_error() const {
    return motion->coulomb() ? motion->coulomb()->error() : pieces_error;
  }

  Holding<D>& holding() { return pieces ? *pieces : held_whole<D>; }
};

/// Puts the motion of a jet of so many beads in pieces on top of the local terms; `jet_of` gives the beads of
/// a piece by number.
using JetOfRows = std::function<Jet<3>(const std::vector<int>&)>;
void hold_in_pieces(Scene<3>& scene, const Parameters& parameters, int beads, const JetOfRows& jet_of,
                    Threads threads, const Ranks& ranks);

template <int D>
Scene<D> compose(const Parameters& parameters, Threads threads, const Ranks& ranks = {});

}  // namespace treejet
