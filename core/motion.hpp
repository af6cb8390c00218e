#pragma once
/// The right-hand side dy/dt = f(t, y) of a jet, as a stepper sees it.
///
/// `jet` tells what is constant within a step: mass and charge of the beads, and whether one is held; its own
/// t and y are not looked at. `slope` is resized to the shape of y.

#include "core/jet.hpp"

namespace treejet {

template <int D>
class Motion {
 public:
  virtual ~Motion() = default;

  /// At any stage of a step.
  virtual void operator()(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) = 0;

  /// At an accepted point of the solution: a motion that remembers (forces/two_rate_motion.hpp) learns here.
  virtual void at_node(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) { (*this)(jet, t, y, slope); }

  /// The oldest bead of `jet` is about to be removed; the youngest one has just been released.
  virtual void before_removal(const Jet<D>&) {}
  virtual void after_release(const Jet<D>&) {}
};

}  // namespace treejet
