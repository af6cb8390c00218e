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

GroupSummaries::GroupSummaries(std::vector<Summary> of_ranks, const TreeShape& shape, int levels_of_table)
    : ranks_(static_cast<int>(of_ranks.size())),
      levels_of_table_(levels_of_table),
      shape_(shape),
      groups_{std::move(of_ranks)} {
  const int levels = SummaryTree(0, ranks_, levels_of_table_).table_level();
  for (int l = 0; l < levels; ++l) {
    const std::vector<Summary>& below = groups_.back();
    std::vector<Summary> level;
    for (std::size_t k = 0; k < below.size(); k += 2)
      level.push_back(k + 1 < below.size()
                          ? joined(below[k], below[k + 1], shape.order, wide_kernels(default_isa()))
                          : below[k]);
    groups_.push_back(std::move(level));
  }
}

/// What the rank tells of its group of the level that the round is about.
std::vector<double> GroupSummaries::message(int from, int round) const {
  const RankGroups groups(ranks_);
  const int table = static_cast<int>(groups_.size()) - 1;
  const bool up = round < groups.levels();
  const int told = up ? std::min(round, table) : groups.levels() + table - 1 - round,
            level = up ? round : told + 1;
  std::vector<double> words;
  for (const int g : groups.within(level, RankGroups::of(from, level), told))
    groups_[index(told)][index(g)].write(words);
  return words;
}

SummaryTree GroupSummaries::play(int rank, const std::function<void(const SummaryTree::Round&)>& sent) const {
  SummaryTree summaries(rank, ranks_, levels_of_table_);
  summaries.begin(groups_[0][index(rank)], shape_, wide_kernels(default_isa()));
  for (int k = 0; k < summaries.rounds(); ++k) {
    const SummaryTree::Round round = summaries.round(k);
    sent(round);
    std::vector<std::vector<double>> in;
    for (const int from : round.from) in.push_back(message(from, k));
    summaries.take(k, in);
  }
  return summaries;
}

SummaryTree GroupSummaries::seen_by(int rank) const {
  return play(rank, [](const SummaryTree::Round&) {});
}

RankTraffic GroupSummaries::traffic_of(int rank) const {
  RankTraffic own;
  play(rank, [&](const SummaryTree::Round& round) {
    const auto readers = static_cast<std::int64_t>(round.to.size());
    own.messages += readers;
    own.message_bytes += readers * static_cast<std::int64_t>(round.message.size()) * word;
  });
  return own;
}

RankTraffic common_traffic() {
  RankTraffic t;
  t.decisions = 1;
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
  std::vector<Summary> of_ranks;
  for (SubdomainTree& tree : trees) {
    tree.equalise(all);
    of_ranks.push_back(EssentialTree::own_summary(tree.tree(), ranks));
  }
  const GroupSummaries summaries(std::move(of_ranks), shape);
  std::vector<RankTraffic> traffic;
  for (int k = 0; k < ranks; ++k) {
    RankTraffic& own = traffic.emplace_back(common_traffic() + summaries.traffic_of(k));
    const SummaryTree seen = summaries.seen_by(k);
    for (const SummaryTree::Near& near : seen.near()) {
      const auto message = EssentialTree::message(trees[index(k)].tree(), near.summary, shape.opening);
      ++own.messages;
      own.message_bytes += static_cast<std::int64_t>(message.size()) * word;
    }
  }
  return traffic;
}

RankTraffic operator+(RankTraffic a, const RankTraffic& b) {
  for (auto count : counts) a.*count += b.*count;
  return a;
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
