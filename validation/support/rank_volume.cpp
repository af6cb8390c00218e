#include "validation/support/rank_volume.hpp"

#include <fmt/format.h>

#include "forces/coulomb/tree/space_order.hpp"

namespace treejet {

namespace {

constexpr std::int64_t word = sizeof(double);

constexpr std::int64_t RankTraffic::*counts[] = {
    &RankTraffic::messages,    &RankTraffic::message_bytes, &RankTraffic::exchanges, &RankTraffic::tables,
    &RankTraffic::table_bytes, &RankTraffic::sums,          &RankTraffic::sum_bytes, &RankTraffic::decisions};

}  // namespace

SubdomainTree::SubdomainTree(const PointSet& points, const TreeShape& shape) : shape_(shape) {
  const PointCharges<3> view = points.view();
  tree_.order = shape.order;
  tree_.cells = Cells(view.n, shape.leaf);
  if (shape.block > 0) tree_.points.reorder(space_order(view.r.data(), view.n, shape.leaf, shape.block, {1}));
  tree_.points.read(view, {1});
  tree_.cells.enclose(tree_.all_points(), wide_kernels(default_isa()).reach, {1});
  tree_.moments.resize(index(tree_.cells.size()) * tree_.moment_stride());
}

void SubdomainTree::equalise(const Cells::Spread& all) {
  if (shape_.even) tree_.cells.equalise_errors(shape_.order, shape_.opening, all, {1});
}

RankTraffic common_traffic(int ranks, std::size_t summary_words) {
  RankTraffic t;
  t.exchanges = t.tables = t.decisions = 1;
  t.table_bytes = (ranks - 1) * static_cast<std::int64_t>(summary_words + 1) * word;
  t.sums = 2;
  t.sum_bytes = t.sums * 2 * word;
  return t;
}

std::vector<RankTraffic> traffic_of(int ranks, const std::function<PointSet(int rank)>& points,
                                    const TreeShape& shape) {
  std::vector<SubdomainTree> trees;
  Cells::Spread all{};
  for (int k = 0; k < ranks; ++k) {
    const Cells::Spread own = trees.emplace_back(points(k), shape).spread();
    all.sum += own.sum, all.points += own.points;
  }
  const EssentialTree others(ranks);
  std::vector<EssentialTree::Message> summaries;
  for (SubdomainTree& tree : trees) {
    tree.equalise(all);
    summaries.push_back(others.summary(tree.tree()));
  }
  std::vector<RankTraffic> traffic;
  for (std::size_t k = 0; k < trees.size(); ++k) {
    RankTraffic& own = traffic.emplace_back(common_traffic(ranks, summaries[k].size()));
    for (std::size_t other = 0; other < trees.size(); ++other) {
      if (other == k) continue;
      const auto words = others.message(trees[k].tree(), summaries[other].data(), shape.opening).size();
      own.messages += words > 0;
      own.message_bytes += static_cast<std::int64_t>(words) * word;
    }
  }
  return traffic;
}

RankTraffic operator-(RankTraffic a, const RankTraffic& b) {
  for (auto count : counts) a.*count -= b.*count;
  return a;
}

bool operator==(const RankTraffic& a, const RankTraffic& b) {
  bool same = true;
  for (auto count : counts) same = same && a.*count == b.*count;
  return same;
}

std::string description(const RankTraffic& t) {
  return fmt::format(
      "{} messages of {} bytes, {} exchanges, {} tables of {} bytes, {} sums of {} bytes, {} decisions",
      t.messages, t.message_bytes, t.exchanges, t.tables, t.table_bytes, t.sums, t.sum_bytes, t.decisions);
}

}  // namespace treejet
