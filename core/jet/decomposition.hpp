#pragma once
/// Who holds the beads of a chain: all of them here, or a subdomain of the chain on each rank.
///
/// With `parallel distributed` the jet of a rank is not the whole one. Its first row is the oldest bead of
/// the chain and its last row the youngest, on every rank and to the same bits; between them are the beads
/// that the rank holds alone (forces/distributed/chain_decomposition.hpp). What happens at the ends of the
/// chain can so be decided by every rank for itself. The rest a march, an output or a checkpoint asks here.

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "core/jet/jet.hpp"
#include "core/jet/spacing.hpp"

namespace treejet {

/// Of a checkpoint of a chain in subdomains: so many beads from this one on, oldest first; or, without beads,
/// what only the rank with that number knows.
struct SubdomainRecord {
  std::int64_t first = 0, count = 0;
  std::string bytes;
};
/// Takes a record into a checkpoint; gives those of a checkpoint that are wanted, known by first and count.
using WriteRecord = std::function<void(const SubdomainRecord&)>;
using ReadRecords =
    std::function<void(const std::function<bool(std::int64_t first, std::int64_t count)>& wanted,
                       const std::function<void(const SubdomainRecord&)>& take)>;

template <int D>
class Decomposition {
 public:
  virtual ~Decomposition() = default;

  /// Whether a rank's jet is a subdomain: maybe all of it, if the rank is alone.
  virtual bool in_subdomains() const { return false; }

  /// Beads of the whole chain, and those that stand before row 0 or have left.
  virtual std::int64_t beads(const Jet<D>& jet) const { return jet.size(); }
  virtual std::int64_t before(const Jet<D>& jet) const { return jet.removed; }

  /// Which beads the rows are (core/jet/jet.hpp).
  virtual IdColumn numbers(const Jet<D>& jet) const {
    return IdColumn::NullaryExpr(jet.size(), [&](Eigen::Index i) { return number(jet.id, jet.removed, i); });
  }

  /// The greatest error of all who hold a subdomain.
  virtual double greatest(double error) const { return error; }

  /// Rows here that nobody else counts, of a table that is as long as the jet.
  virtual std::pair<Eigen::Index, Eigen::Index> own_rows(Eigen::Index rows) const { return {0, rows}; }
  /// Each number becomes the sum of those of all who hold a subdomain.
  virtual void add_up(Eigen::Ref<Eigen::ArrayXd>) const {}

  /// The volumes of all elements of the whole jet, where they may be unequal.
  virtual const Eigen::ArrayXd& all_volumes(const Jet<D>& jet) const { return jet.volume; }

  /// From the oldest bead to the nozzle, of the whole chain.
  virtual double path_length(const State<D>& y, const Vec<D>& nozzle) const {
    return treejet::path_length<D>(y, nozzle);
  }

  /// The youngest row is new, the oldest one has just gone: puts the rows in order, ends included.
  virtual void after_release(Jet<D>&) {}
  virtual void after_removal(Jet<D>&) {}

  /// Gives `take` the oldest `most` beads on the rank that writes files, oldest first, a bounded number at a
  /// time: each a jet of its own, without a slope, in which `removed` counts those before it.
  virtual void in_portions(const Jet<D>& jet, std::int64_t most,
                           const std::function<void(const Jet<D>& some)>& take) const {
    if (most >= jet.size()) return take(jet);
    Jet<D> some = at<D>(jet, jet.t, jet.y.topRows(most));
    for (auto* constants : {&some.mass, &some.charge, &some.volume})
      *constants = constants->head(most).eval();
    if (some.id.size() > 0) some.id = some.id.head(most).eval();
    take(some);
  }

  /// The jet becomes what is to be here of a whole one.
  virtual void take(Jet<D>& jet, const Jet<D>& all) { jet = all; }

  /// What gives the whole jet the beads it needs, the same for all who hold a subdomain; and that done, to
  /// other states of the same beads alike.
  virtual Refinement refinement(const Jet<D>& jet, const Spacing<D>& spacing) const {
    return spacing.refinement(jet);
  }
  virtual void refine(Jet<D>& jet, const Refinement& refinement, std::span<Jet<D>> alike) {
    treejet::refine(jet, refinement);
    for (Jet<D>& other : alike) treejet::refine(other, refinement);
  }

  /// The jet in a checkpoint: what all ranks know of it, and the records behind that.
  virtual void visit(Jet<D>& jet, Archive& state) { state(jet); }
  virtual std::int64_t records() const { return 0; }
  /// `write` is called on the rank that writes files.
  virtual void write(const Jet<D>&, const WriteRecord&) const {}
  /// After `visit` has read. FileError if a bead is missing.
  virtual void read(Jet<D>&, const ReadRecords&) {}
};

/// All of it.
template <int D>
inline Decomposition<D> undivided;

/// Gives the beads ids: from now on `removed + i` does not tell one from another.
template <int D>
void number_beads(Jet<D>& jet, const Decomposition<D>& all = undivided<D>) {
  jet.id = all.numbers(jet) + 1;
  jet.born = jet.removed + all.beads(jet);
}

/// The whole jet, on the rank that writes files: for few beads only.
template <int D>
Jet<D> whole(const Decomposition<D>& decomposition, const Jet<D>& jet) {
  Jet<D> all = without_beads(jet);
  decomposition.in_portions(jet, std::numeric_limits<std::int64_t>::max(),
                            [&](const Jet<D>& some) { append(all, some); });
  return all;
}

}  // namespace treejet
