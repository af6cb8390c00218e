#pragma once
/// When the next event of a jet is to be expected, so that a step can end there instead of being made anew.
///
/// Insertions by their rhythm once it is regular; before that, and removals, as position, velocity,
/// acceleration and jerk of the bead in question foretell them. Nothing depends on a forecast but how long
/// steps are: events are located on the solution (integrators/march/march.hpp). Scaled.

#include <optional>

#include "core/jet/collector.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/observer.hpp"
#include "integrators/march/rhythm.hpp"

namespace treejet {

template <int D>
class Forecast final : public Observer<D> {
 public:
  Forecast(const Nozzle<D>& nozzle, const Collector& collector) : nozzle_(nozzle), collector_(collector) {}

  /// Time from now, jet.t, to the next event, at most `horizon`.
  double next_event(const Jet<D>& jet, double horizon) const;

  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override;
  void event(EventKind kind, const Jet<D>& jet) override;
  void visit(Archive& state) override { state(rhythm_, youngest_jerk_, oldest_jerk_); }

 private:
  double time_to(bool insertion, const Jet<D>& jet, double horizon) const;

  const Nozzle<D>& nozzle_;
  const Collector& collector_;
  Rhythm rhythm_;
  std::optional<Vec<D>> youngest_jerk_,
      oldest_jerk_;  ///< third derivatives, of beads with a step behind them
};

}  // namespace treejet
