#pragma once
/// What ranks that hold a chain in subdomains send in an evaluation of its field, found in one process
/// without them: the trees of the subdomains, their summaries, and the messages that follow from these.
///
/// Counted as Ranks counts it (parallel/ranks.hpp), measurements of the error left out: two sums of two words
/// (points and cuts; the spread of the leaves), a table of summaries, each with the word that `gather` adds,
/// an exchange of messages, and a decision (whether all is finite).

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

/// Of the sums that all ranks make together: for each rank the same.
RankTraffic common_traffic(int ranks, std::size_t summary_words);

/// Of each rank, if `points` gives the subdomain of one. More than one rank.
std::vector<RankTraffic> traffic_of(int ranks, const std::function<PointSet(int rank)>& points,
                                    const TreeShape& shape);

/// The traffic of an evaluation, from what a rank had sent before and after it; of a model, what is left
/// unsaid.
RankTraffic operator-(RankTraffic a, const RankTraffic& b);
bool operator==(const RankTraffic& a, const RankTraffic& b);
std::string description(const RankTraffic& t);

}  // namespace treejet
