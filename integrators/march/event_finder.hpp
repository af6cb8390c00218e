#pragma once
/// Finds the events that end a step: zeros of functions of the state, negative before the event, located on
/// the dense output (core/jet/dense_output.hpp).
///
///     insertion    the nozzle's rule for the youngest bead (core/jet/feed.hpp)
///     removal      the collector's plane, for the oldest (core/jet/collector.hpp)
///     ending       the end of a column, for whichever bead gets there (integrators/march/endings.hpp)
///
/// A jet in subdomains has its youngest and its oldest bead on every rank; all ranks ask alike. Scaled. Source
/// of the search: regula falsi in the Illinois variant, Dowell and Jarratt, BIT 11 (1971) 168.

#include <optional>

#include "core/jet/collector.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/dense_output.hpp"
#include "core/jet/nozzle.hpp"
#include "integrators/march/endings.hpp"

namespace treejet {

template <int D>
class EventFinder {
 public:
  enum class Kind { insertion, removal, ending };
  struct Due {
    double t;
    Kind kind;
  };

  /// All of them outlive it.
  EventFinder(const Nozzle<D>& nozzle, const Collector& collector, const Endings<D>& endings,
              const Decomposition<D>& decomposition)
      : nozzle_(nozzle), collector_(collector), endings_(endings), decomposition_(decomposition) {}

  /// By how much an event is late in a state that the jet is led to, and in that of the jet itself.
  double overdue(Kind kind, const Jet<D>& jet, const State<D>& y, double t) const;
  double overdue(Kind kind, const Jet<D>& jet) const { return overdue(kind, jet, jet.y, jet.t); }

  /// Whether an event is due where another has just happened, but for round-off.
  bool is_due(Kind kind, const Jet<D>& jet) const;

  /// The first event of a step that the jet makes, or of its extrapolation up to `reach`.
  std::optional<Due> first(const Jet<D>& jet, const DenseOutput<D>& step, double reach);

 private:
  double overdue(Kind kind, const Jet<D>& jet, const DenseOutput<D>& step, double t);
  double zero(Kind kind, const Jet<D>& jet, const DenseOutput<D>& step, double a, double b);

  const Nozzle<D>& nozzle_;
  const Collector& collector_;
  const Endings<D>& endings_;
  const Decomposition<D>& decomposition_;
  State<D> one_;  ///< a bead within a step
};

}  // namespace treejet
