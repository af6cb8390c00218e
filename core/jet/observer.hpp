#pragma once
/// Whoever looks at a run while it goes on: outputs, statistics, progress. A watcher changes nothing.
/// In a run that is resumed `visit` takes the place of `start`.

#include "core/jet/dense_output.hpp"
#include "core/jet/refinement.hpp"

namespace treejet {

/// What ends a smooth piece of the solution; observers are told of the first three.
enum class EventKind { place, release, removal, kink };

template <int D>
class Observer {
 public:
  virtual ~Observer() = default;

  /// The jet before the first step.
  virtual void start(const Jet<D>&) {}

  /// The solution over begin <= t < until. An output due exactly at `until` belongs to the next segment: it
  /// shows the jet after the events of that instant. `jet` gives what is constant in the segment: mass,
  /// charge, held.
  virtual void segment(const Jet<D>&, const DenseOutput<D>&) {}

  /// An event at jet.t. For a placement and a release `jet` is the jet after it, for a removal the jet before
  /// it.
  virtual void event(EventKind, const Jet<D>&) {}

  /// Elements have been split and merged; `jet` is the jet after it.
  virtual void refined(const Jet<D>&, const Refinement&) {}

  /// The jet after the last step.
  virtual void finish(const Jet<D>&) {}

  /// What a watcher remembers from one segment to the next.
  virtual void visit(Archive&) {}
};

}  // namespace treejet
