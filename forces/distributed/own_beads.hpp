#pragma once
/// The own beads of a rank, without copies of the ends, while elements of the chain are split and merged.
///
/// Which elements are is decided by each rank for its own, on as many beads of its neighbours as tell: a few,
/// unless elements wait for each other, or merge by turns, from one subdomain to the next. What is done to a
/// bead turns on four beads on either side. No rank so has more than its own beads and some next to them, and
/// the bits are those of the whole.

#include "core/jet/spacing.hpp"
#include "forces/distributed/bead_moves.hpp"

namespace treejet {

class OwnBeads {
 public:
  /// Of rows that a layout tells.
  OwnBeads(const Ranks& ranks, const Jet<3>& jet, const Layout& layout);

  /// With some beads beyond, as far as the chain goes.
  Jet<3> with_neighbours(int beyond) const;

  /// The elements or beads of the whole chain to which a pass is due.
  std::vector<Eigen::Index> asking(const Spacing<3>& spacing, RefinementPass::Kind kind) const;
  void refine(const RefinementPass& pass);

  const Jet<3>& jet() const { return jet_; }
  const Layout& layout() const { return layout_; }

 private:
  Stretch own() const { return layout_.own(ranks_.rank()); }

  Ranks ranks_;
  Layout layout_;
  Jet<3> jet_;
};

}  // namespace treejet
