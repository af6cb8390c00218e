#pragma once
/// Marches a jet through time and its events.
///
/// Insertion (place, release), removal and the end of a bead's column are zeros of functions of the state
/// (event_finder.hpp). Order at one instant: insertion, then removal, then whatever these have made due, until
/// nothing is, then refinement. The last bead is never removed while beads are inserted; without insertion
/// the march ends with an empty jet. With EventRule::step both are
/// looked for at the ends of steps only, at most one of each a step: JETSPIN's way, first order in the step
/// whatever the scheme. No step goes over the end of a piece of time within which the right-hand side is
/// smooth.
///
/// Errors: NumericalError names bead, time and likely cause when the state is no longer finite, a step falls
/// below round-off, or beads of a straight jet have crossed. The watchers have seen everything up to there.

#include <functional>
#include <optional>
#include <vector>

#include "core/jet/collector.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/error_norm.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/observer.hpp"
#include "core/jet/spacing.hpp"
#include "integrators/march/endings.hpp"
#include "integrators/march/event_finder.hpp"
#include "integrators/march/forecast.hpp"
#include "integrators/march/step_control.hpp"
#include "integrators/schemes/stepper.hpp"

namespace treejet {

/// Work done by a march.
struct Effort {
  std::int64_t evaluations = 0, steps = 0, rejected = 0, retaken = 0, placed = 0, released = 0, removed = 0;
  std::int64_t split = 0, merged = 0;  ///< elements
  double begun = 0, drawn = 1;         ///< when, and what was behind the youngest bead then; scaled
  double arrived = 0;                  ///< volume of the beads removed, as it left the nozzle; scaled
};

template <int D>
class March {
 public:
  struct Parts {
    Jet<D>& jet;
    RightHandSide<D>& motion;
    Stepper<D>& stepper;
    StepControl& control;
    const Nozzle<D>& nozzle;
    const Collector& collector;
    EventRule events;
    ErrorNorm norm;
    Endings<D> endings;
    std::vector<Observer<D>*> observers;
    std::function<bool()> stop_here = {};  ///< asked between any two steps: whether to stop there
    Decomposition<D>& decomposition = undivided<D>;
    const Spacing<D>* spacing = nullptr;  ///< null: elements are neither split nor merged
    /// Told once, before the first step that another end might have made longer.
    std::function<void()> end_in_sight = {};
  };

  explicit March(const Parts& parts)
      : parts_(parts),
        jet_(parts.jet),
        events_(parts.nozzle, parts.collector, parts_.endings, parts.decomposition),
        forecast_(parts.nozzle, parts.collector) {}
  March(const March&) = delete;
  March& operator=(const March&) = delete;

  /// On to scaled time `end`, or until the jet is empty. False if told to pause before; the next call goes on
  /// from there.
  bool to(double end);

  const Effort& effort() const { return effort_; }
  double t() const { return jet_.t; }

  /// All between two steps: the march, what it moves and by what rules. Not the watchers.
  void visit(Archive& state);

  /// Goes on from another march, whose state is read, and by `read_beads` what of it stands elsewhere, with
  /// watchers that see this as the start.
  void take_over(Archive& state, const std::function<void()>& read_beads);

 private:
  using Kind = typename EventFinder<D>::Kind;
  using Due = typename EventFinder<D>::Due;

  bool aims() const { return parts_.control.steps_to_events() && parts_.events == EventRule::located; }
  void start();
  void begin_piece();
  bool nears(double end) const;
  void evaluate(SolutionPoint<D>& point, const State<D>* known = nullptr);
  void step(double h);
  DenseOutput<D> segment() const;
  double error() const;
  [[noreturn]] void give_up() const;
  double attempt(double end);
  std::optional<Due> located_event(double reach);
  void commit(std::optional<Due> due);
  void announce(EventKind kind);
  void insertion();
  void placement();
  void removal();
  void settle(const Due& due);
  bool look_at_step_end();
  bool hold_ended(double missing = 0);
  bool refine_if_due(std::int64_t released_before);

  Parts parts_;
  Jet<D>& jet_;                                 ///< the solution now
  SolutionPoint<D> next_;                       ///< the end of a step, until the jet goes there
  const FastRegion<D>* fast_region_ = nullptr;  ///< through the last step, null if all beads were integrated
  State<D> fast_next_;
  EventFinder<D> events_;
  Forecast<D> forecast_;
  Effort effort_;
  double piece_begin_ = 0, piece_end_ = 0;  ///< within which the right-hand side is smooth
  bool under_way_ = false;                  ///< started, and not yet at the end
};

}  // namespace treejet
