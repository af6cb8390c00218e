#pragma once
/// The right-hand side dy/dt = f(t, y) of a jet, as a stepper sees it.
///
/// `jet` tells what is constant within a step: mass, charge and volume of the beads, and whether one is held.
/// A stage is asked for by its own t and y. `slope` is resized to the shape of y.

#include <limits>
#include <stdexcept>
#include <vector>

#include "core/jet/dense_output.hpp"
#include "core/jet/local_jacobian.hpp"

namespace treejet {

/// The beads that a step integrates stage by stage, as a jet of their own: the first rows are the `oldest`
/// beads of the whole jet, the rest its youngest.
template <int D>
struct FastRegion {
  Jet<D> jet;
  Eigen::Index oldest = 0;
};

template <int D>
class RightHandSide {
 public:
  virtual ~RightHandSide() = default;

  /// At any stage of a step.
  virtual void operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) = 0;

  /// At an accepted point of the solution: a right-hand side that remembers
  /// (forces/multirate/multirate_motion.hpp) learns here. `known` is the slope that a stage has found there,
  /// of the fast region if a step integrates no more. True if forces had to be evaluated.
  virtual bool on_accepted_step(const Jet<D>& jet, double t, const State<D>& y, const State<D>* known,
                                State<D>& slope) {
    if (known)
      slope = *known;
    else
      (*this)(jet, t, y, slope);
    return !known;
  }

  /// A right-hand side that is smooth in pieces of time: from t on, until the time it gives back, all stages
  /// see the smooth continuation of the piece that begins at t. The march ends a step there and asks anew.
  virtual double smooth_from(double /*t*/) { return std::numeric_limits<double>::infinity(); }

  /// The longest step that a right-hand side which extrapolates what it remembers allows from here.
  virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }

  /// A right-hand side that knows the way of some beads through a step from here gives the others. The stages
  /// of the step are then asked for with these beads' jet and tables only. Null: all beads are integrated.
  virtual const FastRegion<D>* fast_region(const Jet<D>&) { return nullptr; }
  /// All beads after a step of length h that has led those of the fast region to `some`.
  virtual void complete(const Jet<D>&, double /*h*/, const State<D>& /*some*/, State<D>& /*next*/) {}

  /// The derivative of the local part of the slope, for the schemes that solve for it.
  virtual void differentiate(const Jet<D>&, double, const State<D>&, LocalJacobian<D>&) {
    throw std::logic_error("a motion without a Jacobian");
  }

  /// The oldest bead of `jet` is about to be removed; the youngest one has just been released.
  virtual void before_removal(const Jet<D>&) {}
  virtual void after_release(const Jet<D>&) {}

  /// The elements of `jet` are about to be split and merged: the states of its past that a motion remembers,
  /// to be refined alike.
  virtual std::vector<Jet<D>> past(const Jet<D>&) { return {}; }
  /// They have been. Returns the evaluations of the forces that it took to learn of it.
  virtual std::int64_t after_refinement(const Jet<D>&, std::vector<Jet<D>> /*past*/) { return 0; }

  /// What a motion remembers from one evaluation to the next.
  virtual void visit(Archive&) {}
};

}  // namespace treejet
