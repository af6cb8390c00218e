#pragma once
/// The right-hand side dy/dt = f(t, y) of a jet, as a stepper sees it.
///
/// `jet` tells what is constant within a step: mass and charge of the beads, and whether one is held; its own
/// t and y are not looked at. `slope` is resized to the shape of y.

#include <limits>
#include <stdexcept>

#include "core/jet/dense_output.hpp"
#include "core/jet/local_jacobian.hpp"

namespace treejet {

/// The beads that a step follows stage by stage, as a jet of their own, and where they set out from: the
/// first rows are the `oldest` beads of the whole jet, the rest its youngest.
template <int D>
struct FastRegion {
  Jet<D> jet;  ///< what is constant in it
  SolutionPoint<D> from;
  Eigen::Index oldest = 0;
};

template <int D>
class RightHandSide {
 public:
  virtual ~RightHandSide() = default;

  /// At any stage of a step.
  virtual void operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) = 0;

  /// At an accepted point of the solution: a motion that remembers (forces/multirate/multirate_motion.hpp)
  /// learns here. `known` is the slope that a stage has found there, of the followed beads if a step follows
  /// some. True if forces had to be evaluated.
  virtual bool on_accepted_step(const Jet<D>& jet, double t, const State<D>& y, const State<D>* known,
                                State<D>& slope) {
    if (known)
      slope = *known;
    else
      (*this)(jet, t, y, slope);
    return !known;
  }

  /// The longest step that a motion which continues what it remembers allows from an accepted point.
  virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }

  /// A motion that knows the way of some beads through a step from here gives the others, without t and y of
  /// their jet. The stages of the step are then asked for with these beads' jet and tables only. Null: all
  /// beads are to be followed.
  virtual const FastRegion<D>* fast_region(const Jet<D>&, const SolutionPoint<D>&) { return nullptr; }
  /// All beads after a step of length h that has led the followed ones to `some`.
  virtual void complete(const Jet<D>&, const SolutionPoint<D>& /*from*/, double /*h*/,
                        const State<D>& /*some*/, State<D>& /*next*/) {}

  /// The derivative of the local part of the slope, for the schemes that solve for it.
  virtual void differentiate(const Jet<D>&, double, const State<D>&, LocalJacobian<D>&) {
    throw std::logic_error("a motion without a Jacobian");
  }

  /// The oldest bead of `jet` is about to be removed; the youngest one has just been released.
  virtual void before_removal(const Jet<D>&) {}
  virtual void after_release(const Jet<D>&) {}

  /// What a motion remembers from one evaluation to the next.
  virtual void visit(Archive&) {}
};

}  // namespace treejet
