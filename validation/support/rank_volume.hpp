#pragma once
/// What ranks that hold a chain in subdomains send in an evaluation of its field, found in one process
/// without them: the trees of the subdomains, the summaries of all groups of ranks, and what a rank in the
/// place of any of them would send.
///
/// Counted as Ranks counts it (parallel/ranks.hpp), measurements of the error left out: two sums of two words
/// (points and cuts; the spread of the leaves), a decision (whether all is finite), and messages.

#include <functional>
#include <vector>

#include "forces/coulomb/tree/essential_tree.hpp"
#include "validation/support/point_sets.hpp"

namespace treejet {

/// The tree of a subdomain with room for moments, which nobody looks at.
class SubdomainTree {
 public:
  SubdomainTree(const PointSet& points, const TreeShape& shape);

  Cells::Spread spread() const { return tree_.cells.spread(); }
  /// As ranks do that have summed theirs up.
  void equalise(const Cells::Spread& all);
  const Tree& tree() const { return tree_; }

 private:
  TreeShape shape_;
  Tree tree_;
};

/// The summaries of all groups of ranks, and what each rank learns of them.
class GroupSummaries {
 public:
  GroupSummaries(std::vector<Summary> of_ranks, const TreeShape& shape, int levels_of_table = 9);

  /// Where a rank is when it knows whom to send messages.
  SummaryTree seen_by(int rank) const;
  /// What it has sent until then.
  RankTraffic traffic_of(int rank) const;

 private:
  std::vector<double> message(int from, int round) const;
  /// Calls for each round what a rank sends in it.
  SummaryTree play(int rank, const std::function<void(const SummaryTree::Round&)>& sent) const;

  int ranks_, levels_of_table_;
  TreeShape shape_;
  std::vector<std::vector<Summary>> groups_;  ///< by level, up to that of the table
};

/// Of the sums that all ranks make together: for each rank the same.
RankTraffic common_traffic();

/// Of each rank, if `points` gives the subdomain of one. More than one rank.
std::vector<RankTraffic> traffic_of(int ranks, const std::function<PointSet(int rank)>& points,
                                    const TreeShape& shape);

/// The traffic of an evaluation, from what a rank had sent before and after it; of a model, what is left
/// unsaid.
RankTraffic operator+(RankTraffic a, const RankTraffic& b);
RankTraffic operator-(RankTraffic a, const RankTraffic& b);
bool operator==(const RankTraffic& a, const RankTraffic& b);
std::string description(const RankTraffic& t);

}  // namespace treejet
