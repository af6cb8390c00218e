#pragma once
/// A chain cut into contiguous pieces, one a rank, each a few rows of the jet (core/jet/decomposition.hpp).
///
///     row 0             rows own()                       last row
///     oldest bead       the beads of this rank alone     youngest bead
///
/// The rank that holds the oldest bead has it as its first own row, the one that holds the youngest bead as
/// its last; for all others these two rows are copies. Insertion adds to the piece at the nozzle, removal
/// takes from that at the collector, and as every rank sees both, all know all counts without asking. When a
/// piece has grown a fifth beyond its share, or that at the collector is down to one bead, the chain is cut
/// anew. Pieces have at least four beads: in a short chain some ranks have none.
///
/// Weak: what looks at neighbouring rows (integrators/march/diagnosis.hpp) takes the own beads next to a copy
/// for its neighbours, and sees no element from one piece to the next.

#include <vector>

#include "core/jet/decomposition.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

class ChainDecomposition final : public Decomposition<3> {
 public:
  ChainDecomposition(int beads, const Ranks& ranks);

  /// The beads of the whole chain that the rows of this rank's jet are, by number.
  std::vector<int> rows() const;

  /// The rows that are this rank's own.
  Rows own() const;
  bool has_oldest() const { return ranks_.rank() == end(0); }
  bool has_youngest() const { return ranks_.rank() == end(1); }
  /// Ranks with the pieces next to this one, towards the collector and towards the nozzle; -1: none.
  int older() const { return neighbour(-1); }
  int younger() const { return neighbour(+1); }
  const Ranks& ranks() const { return ranks_; }
  int recuts() const { return recuts_; }

  bool whole_here() const override { return ranks_.size() == 1; }
  std::int64_t beads(const Jet<3>&) const override { return total(); }
  std::int64_t before(const Jet<3>& jet) const override {
    return jet.removed + first(ranks_.rank()) - own().first;
  }
  double greatest(double error) const override;
  void after_release(Jet<3>& jet) override;
  void after_removal(Jet<3>& jet) override;
  Jet<3> whole(Jet<3>&& jet) const override;

 private:
  int total() const { return first(ranks_.size()); }
  int first(int rank) const;
  int end(int which) const;
  int neighbour(int step) const;
  int fair_share(int beads) const;
  void cut(int beads);
  bool out_of_balance() const;
  void recut(Jet<3>& jet);

  Ranks ranks_;
  std::vector<int> counts_;  ///< own beads of each rank
  int recuts_ = 0;
};

}  // namespace treejet
