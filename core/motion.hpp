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
  virtual void operator()(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) = 0;
};

}  // namespace treejet
