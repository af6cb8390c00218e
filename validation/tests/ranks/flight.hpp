#pragma once
/// A jet that flies for some time, held whole or in subdomains, and how two such flights differ.

#include <algorithm>
#include <vector>

#include "forces/distributed/chain_decomposition.hpp"
#include "validation/support/run.hpp"

namespace treejet {

struct Flight {
  std::vector<Jet<3>> jets;  ///< whole ones, on the first rank
  Effort effort;
  int recuts = 0;
  std::int64_t full_evaluations = 0;  ///< at two rates
  double t = 0;
};

/// With a jet each `interval`, s.
inline Flight flight(Run<3>& run, double seconds, double interval) {
  Snapshots<3> snapshots(interval / run.unit.time);
  snapshots.sample_all(run.scene.decomposition());
  Flight f;
  f.effort = run.to(seconds, {&snapshots});
  f.jets = snapshots.jets;
  if (const auto* subdomains = dynamic_cast<const ChainDecomposition*>(&run.scene.decomposition()))
    f.recuts = subdomains->recuts();
  if (run.scene.multirate) f.full_evaluations = run.scene.multirate->full_evaluations();
  f.t = run.jet().t;
  return f;
}

/// The largest difference of a coordinate, against the distance from nozzle to collector; 1e300 if the beads
/// are not the same ones, with the same ids, masses, charges and volumes.
inline double difference(const Flight& a, const Flight& b, const Parameters& p) {
  if (a.jets.size() != b.jets.size()) return 1e300;
  double largest = 0;
  for (std::size_t k = 0; k < a.jets.size(); ++k) {
    const Jet<3>&one = a.jets[k], &other = b.jets[k];
    if (one.size() != other.size() || one.removed != other.removed) return 1e300;
    if (one.id.size() != other.id.size() || (one.id != other.id).any()) return 1e300;
    for (auto each : {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume})
      if ((one.*each != other.*each).any()) return 1e300;
    largest = std::max(largest, (one.y.leftCols<3>() - other.y.leftCols<3>()).abs().maxCoeff());
  }
  return largest * scales(p).length / p.collector_distance;
}

/// What the first rank has found, to all.
inline double told_by_first(double found, const Ranks& ranks) {
  double value = ranks.first() ? found : 0;
  ranks.sum({&value, 1});
  return value;
}

}  // namespace treejet
