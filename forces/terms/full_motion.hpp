#pragma once
/// A right-hand side with all forces of the scene, of which the last evaluation can be looked at: what
/// multirate (forces/multirate/multirate_motion.hpp) continues in time.

#include <utility>

#include "core/jet/chain.hpp"
#include "core/jet/right_hand_side.hpp"
#include "parallel/rows.hpp"

namespace treejet {

template <int D>
class FullMotion : public RightHandSide<D> {
 public:
  /// The points of the last evaluation, and the Coulomb field of all charges at its beads.
  virtual const Chain<D>& chain() const = 0;
  virtual const typename Chain<D>::Points& field() const = 0;
  /// Its elements of which each is counted once, by one rank: a chain, and rows of it.
  virtual std::pair<const Chain<D>*, Rows> own_elements() const = 0;
  /// The group of the Coulomb force, 0 without charge.
  virtual double Q() const = 0;
};

}  // namespace treejet
