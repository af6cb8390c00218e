#pragma once
/// How a rank learns of all others what it needs from afar, from few of them: by a tree of summaries over
/// groups of ranks (parallel/rank_groups.hpp).
///
///     up      On each level a group and its sibling tell each other their summaries, and each rank joins the
///             two into that of the group above. From the level on which there are few groups, they tell each
///             other those of that level, so that at the end each rank has a table of them all.
///     down    From the table each rank sees which groups are far, which it sees as one closed cell, and
///             which are near. Groups below the table that are near each other tell each other of what they
///             consist, level by level.
///
/// At the end every other subdomain is in exactly one of the `far` groups or is one of the `near` ranks, and
/// who is near to whom is known to both. Up to 512 ranks that takes a message to each of log2 P others;
/// beyond, each level more takes a round more in which a rank hears of no more groups than are near to its
/// own, where a table of all ranks would have twice as many rows. What `Round` says is sent and received by
/// the caller: by ranks, or by whoever wants to see what they would send.

#include <algorithm>
#include <vector>

#include "forces/coulomb/tree/summary.hpp"
#include "parallel/rank_groups.hpp"

namespace treejet {

class SummaryTree {
 public:
  /// A table of up to 2^levels_of_table groups: a message more takes as long as the bytes of some twenty of
  /// their summaries.
  SummaryTree(int rank, int ranks, int levels_of_table = 9)
      : rank_(rank), groups_(ranks), table_level_(std::max(0, groups_.levels() - levels_of_table)) {}
  /// The level of which all ranks have all summaries.
  int table_level() const { return table_level_; }

  /// One message to all of `to`, and one from each of `from`.
  struct Round {
    std::vector<int> to, from;
    std::vector<double> message;
  };
  struct Near {
    int group;  ///< at the end a rank
    Summary summary;
  };

  int rounds() const { return groups_.levels() + table_level_; }
  /// Anew, with this rank's own summary.
  void begin(Summary own, const TreeShape& shape, const WideKernels& kernels);
  /// Round k; called when the messages of those before are taken.
  Round round(int k) const;
  void take(int k, const std::vector<std::vector<double>>& messages);

  /// After the last round.
  const std::vector<Summary>& far() const { return far_; }
  const std::vector<Near>& near() const { return near_; }

 private:
  bool up(int k) const { return k < groups_.levels(); }
  int level(int k) const { return up(k) ? k : groups_.levels() + table_level_ - 1 - k; }
  int own(int level) const { return RankGroups::of(rank_, level); }
  int sibling(int level) const { return own(level) ^ 1; }
  bool has_sibling(int level) const { return groups_.exists(level, sibling(level)); }
  void take_up(int level, SummaryReader reader);
  void climb(int level);
  std::vector<Near> others_of_table();
  void look_at(const Summary& here, std::vector<Near> candidates);

  int rank_;
  RankGroups groups_;
  int table_level_;
  double opening_ = 0;
  int order_ = 0;
  const WideKernels* kernels_ = nullptr;
  std::vector<Summary> path_, siblings_;  ///< by level, below the table
  std::vector<Summary> table_;
  std::vector<Near> near_;  ///< to the own group of the level last looked at
  std::vector<Summary> far_;
};

}  // namespace treejet
