#pragma once
/// One measured run of the scaling study, in a process (or rank) of its own.
///
/// The jet is the paper's case 3 at 12 ms, whipping from nozzle to collector, its elements cut in
/// `refinement` parts: what a deck with so much smaller an l_step would hold. It is moved by the deck's own
/// scheme, every term at every stage, for a number of evaluations after a warm-up.

#include <string>

#include "core/jet/parameters.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

struct ScalingRun {
  int refinement = 1;
  CoulombSum sum = CoulombSum::direct;
  int threads = 1, evaluations = 100;
  bool subdomains = false;  ///< the chain cut in one subdomain a rank; else replicated
};

struct Measurement {
  int beads = 0;
  double seconds = 0, exchange = 0, wait = 0;  ///< of an evaluation; the latter two the mean over ranks
  std::string bits;                            ///< a hash of the last slopes
  std::string cores;                           ///< of each rank, "0-1,2-3"
};

Measurement measure(const ScalingRun& run, const Ranks& ranks);

/// One line, and back.
std::string text(const Measurement& m);
Measurement measurement(const std::string& text);

}  // namespace treejet
