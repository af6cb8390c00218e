#pragma once
/// A chain cut into contiguous subdomains, one a rank, each a few rows of the jet
/// (core/jet/decomposition.hpp).
///
///     rows              rows own()                       rows
///     oldest beads      the beads of this rank alone     youngest beads
///
/// The oldest and the youngest beads, one each or as many as `ends` says, are rows of every rank: of those
/// that hold them their own, of the others copies. Insertion adds to the subdomain at the nozzle, removal
/// takes from that at the collector, and as every rank sees both, all know all counts without asking. When a
/// subdomain has grown a fifth beyond its share, or that at the collector is down to one bead, the chain is
/// cut anew. Subdomains have at least four beads, but for one: in a short chain some ranks have none.
///
/// Files and checkpoints get the chain in portions, which the ranks hand to the first one in turn: it holds
/// no more than one at a time beside its own subdomain. A checkpoint may be read by any number of ranks, each
/// of which takes the beads that are then its own; on as many as before the chain is cut as it was.
///
/// Elements are split and merged as in the whole jet, each by the rank that has it, which sees a few beads of
/// its neighbours (own_beads.hpp).
///
/// Weak: what looks at neighbouring rows (integrators/march/diagnosis.hpp) takes the own beads next to a copy
/// for its neighbours, and sees no element from one subdomain to the next.

#include <functional>
#include <span>
#include <vector>

#include "core/jet/decomposition.hpp"
#include "forces/distributed/bead_words.hpp"
#include "forces/distributed/layout.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

class ChainDecomposition final : public Decomposition<3> {
 public:
  ChainDecomposition(int beads, const Ranks& ranks, Ends ends = {});

  /// The beads of the whole chain that the rows of this rank's jet are, by number.
  std::vector<int> rows() const;

  /// The rows that are this rank's own.
  Rows own() const;
  bool has_youngest() const { return ranks_.rank() == layout_.holder(total() - 1); }
  /// Ranks with the subdomains next to this one, towards the collector and towards the nozzle; -1: none.
  int older() const { return neighbour(-1); }
  int younger() const { return neighbour(+1); }
  const Ranks& ranks() const { return ranks_; }
  int recuts() const { return recuts_; }

  /// Elements may be unequal, and all ranks know the volumes of all: sent whenever beads have come or gone.
  void share_volumes() { shares_volumes_ = true; }
  bool shares_volumes() const { return shares_volumes_; }
  const Eigen::ArrayXd& all_volumes(const Jet<3>& jet) const override;

  /// Turns the rows of a table that stand for beads at the ends into what their holders have there.
  void share_ends(Eigen::Ref<Eigen::ArrayXXd> table) const;

  /// Numbers by bead that go where the beads go: of so many rows of the jet, `rows` gives and `set` takes a
  /// row each.
  using CarriedRows = std::function<Eigen::ArrayXXd(Eigen::Index first, Eigen::Index count)>;
  void carry(CarriedRows rows, std::function<void(const Eigen::ArrayXXd&)> set) {
    carried_ = std::move(rows), set_carried_ = std::move(set);
  }
  /// What a rank knows by itself goes through checkpoints as long as the chain is cut the same.
  void keep(std::function<void(Archive&)> own_state) { own_state_ = std::move(own_state); }

  bool in_subdomains() const override { return true; }
  std::int64_t beads(const Jet<3>&) const override { return total(); }
  std::int64_t before(const Jet<3>& jet) const override {
    return jet.removed + layout_.own(ranks_.rank()).first - own().first;
  }
  IdColumn numbers(const Jet<3>& jet) const override;
  double greatest(double error) const override;
  void add_up(Eigen::Ref<Eigen::ArrayXd> numbers) const override;
  std::pair<Eigen::Index, Eigen::Index> own_rows(Eigen::Index rows) const override;
  double path_length(const State<3>& y, const Vec<3>& nozzle) const override;
  void after_release(Jet<3>& jet) override;
  void after_removal(Jet<3>& jet) override;
  void in_portions(const Jet<3>& jet, std::int64_t most,
                   const std::function<void(const Jet<3>& some)>& take) const override;

  void take(Jet<3>& jet, const Jet<3>& all) override;
  Refinement refinement(const Jet<3>& jet, const Spacing<3>& spacing) const override;
  /// What is carried along is not: whoever has it learns of the refinement by the jets of the past.
  void refine(Jet<3>& jet, const Refinement& refinement, std::span<Jet<3>> alike) override;

  void visit(Jet<3>& jet, Archive& state) override;
  std::int64_t records() const override;
  void write(const Jet<3>& jet, const WriteRecord& write) const override;
  void read(Jet<3>& jet, const ReadRecords& records) override;

 private:
  int total() const { return layout_.total(); }
  int neighbour(int step) const;
  void cut(int beads);
  bool out_of_balance() const;
  void arrange(Jet<3>& jet, const Layout& had);
  void recut_if_due(Jet<3>& jet);
  std::string portion(const Jet<3>& jet, int rank, Stretch beads) const;

  Ranks ranks_;
  Ends ends_;
  Layout layout_;
  int recuts_ = 0;
  bool shares_volumes_ = false;
  int changes_ = 0;  ///< of the beads
  mutable Eigen::ArrayXd volumes_;
  mutable int volumes_since_ = -1;  ///< `changes_` then
  CarriedRows carried_ = [](Eigen::Index, Eigen::Index count) { return Eigen::ArrayXXd(count, 0); };
  std::function<void(const Eigen::ArrayXXd&)> set_carried_ = [](const Eigen::ArrayXXd&) {};
  std::function<void(Archive&)> own_state_;
  bool cut_as_saved_ = true;  ///< what was read last was of as many ranks
};

}  // namespace treejet
