#pragma once
/// Who holds the beads of a chain: all of them here, or a piece of the chain on each rank.
///
/// With `parallel distributed` the jet of a rank is not the whole one. Its first row is the oldest bead of
/// the chain and its last row the youngest, on every rank and to the same bits; between them are the beads
/// that the rank holds alone (forces/distributed/chain_decomposition.hpp). What happens at the ends of the
/// chain can so be decided by every rank for itself. The rest a march or an output asks here.

#include "core/jet/jet.hpp"

namespace treejet {

template <int D>
class Decomposition {
 public:
  virtual ~Decomposition() = default;

  /// Whether the jet is the whole one.
  virtual bool whole_here() const { return true; }

  /// Beads of the whole chain, and those that stand before row 0 or have left.
  virtual std::int64_t beads(const Jet<D>& jet) const { return jet.size(); }
  virtual std::int64_t before(const Jet<D>& jet) const { return jet.removed; }

  /// The greatest error of all who hold a piece.
  virtual double greatest(double error) const { return error; }

  /// The youngest row is new, the oldest one has just gone: puts the rows in order, ends included.
  virtual void after_release(Jet<D>&) {}
  virtual void after_removal(Jet<D>&) {}

  /// The whole jet, on the rank that writes files.
  virtual Jet<D> whole(Jet<D>&& jet) const { return std::move(jet); }
};

/// All of it.
template <int D>
inline Decomposition<D> undivided;

}  // namespace treejet
