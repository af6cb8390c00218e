#pragma once
/// The right-hand side dy/dt = f(t, y) of a jet, as a stepper sees it.
///
/// `jet` tells what is constant within a step: mass and charge of the beads, and whether one is held; its own
/// t and y are not looked at. `slope` is resized to the shape of y.

#include <stdexcept>

#include "core/jet.hpp"
#include "core/local_jacobian.hpp"

namespace treejet {

template <int D>
class Motion {
 public:
  virtual ~Motion() = default;

  /// At any stage of a step.
  virtual void operator()(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) = 0;

  /// At an accepted point of the solution: a motion that remembers (forces/two_rate_motion.hpp) learns here.
  virtual void at_node(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) {
    (*this)(jet, t, y, slope);
  }

  /// The derivative of the local part of the slope, for the schemes that solve for it.
  virtual void differentiate(const Jet<D>&, double, const Table<D>&, LocalJacobian<D>&) {
    throw std::logic_error("a motion without a Jacobian");
  }

  /// The oldest bead of `jet` is about to be removed; the youngest one has just been released.
  virtual void before_removal(const Jet<D>&) {}
  virtual void after_release(const Jet<D>&) {}

  /// What a motion remembers from one evaluation to the next.
  virtual void visit(Archive&) {}
};

}  // namespace treejet
