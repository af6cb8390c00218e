#include "forces/coulomb/tree/summary_tree.hpp"

#include <utility>

namespace treejet {

void SummaryTree::begin(Summary own_one, const TreeShape& shape, const WideKernels& kernels) {
  opening_ = shape.opening;
  order_ = shape.order;
  kernels_ = &kernels;
  siblings_.assign(index(table_level_), {});
  table_.assign(index(groups_.count(table_level_)), {});
  path_.assign(index(table_level_ + 1), {});
  path_[0] = std::move(own_one);
  if (table_level_ == 0) table_[index(rank_)] = path_[0];
  near_.clear();
  far_.clear();
}

SummaryTree::Round SummaryTree::round(int k) const {
  Round round;
  const int l = level(k);
  const auto hear_of = [&](int level, int group) {
    const std::vector<int> readers = groups_.readers(level, rank_, group);
    round.to.insert(round.to.end(), readers.begin(), readers.end());
    round.from.push_back(groups_.writer(level, rank_, group));
  };
  if (!up(k)) {
    for (const Near& near : near_) hear_of(l + 1, near.group);
    if (near_.empty()) return round;
    const bool first = own(l) < sibling(l);
    (first ? path_ : siblings_)[index(l)].write(round.message);
    if (has_sibling(l)) (first ? siblings_ : path_)[index(l)].write(round.message);
  } else if (has_sibling(l)) {
    hear_of(l, sibling(l));
    if (l < table_level_)
      path_[index(l)].write(round.message);
    else
      for (const int g : groups_.within(l, own(l), table_level_)) table_[index(g)].write(round.message);
  }
  return round;
}

void SummaryTree::take(int k, const std::vector<std::vector<double>>& messages) {
  const int l = level(k);
  const std::size_t moments = index(padded(Series::terms(order_ - 1)));
  if (up(k)) {
    if (has_sibling(l)) take_up(l, {messages[0], moments});
    if (l < table_level_) climb(l);
    if (l + 1 == groups_.levels()) look_at(path_[index(table_level_)], others_of_table());
    return;
  }
  std::vector<Near> candidates;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    SummaryReader children(messages[n], moments);
    for (const int child : groups_.within(l + 1, near_[n].group, l))
      candidates.push_back({child, children.next()});
  }
  if (has_sibling(l)) candidates.push_back({sibling(l), siblings_[index(l)]});
  look_at(path_[index(l)], std::move(candidates));
}

void SummaryTree::take_up(int l, SummaryReader reader) {
  if (l < table_level_)
    siblings_[index(l)] = reader.next();
  else
    for (const int g : groups_.within(l, sibling(l), table_level_)) table_[index(g)] = reader.next();
}

/// To the own group of the next level.
void SummaryTree::climb(int l) {
  const bool first = own(l) < sibling(l);
  const Summary &here = path_[index(l)], &there = siblings_[index(l)];
  path_[index(l + 1)] = joined(first ? here : there, first ? there : here, order_, *kernels_);
  if (l + 1 == table_level_) table_[index(own(l + 1))] = path_[index(l + 1)];
}

std::vector<SummaryTree::Near> SummaryTree::others_of_table() {
  std::vector<Near> others;
  for (int g = 0; g < groups_.count(table_level_); ++g)
    if (g != own(table_level_)) others.push_back({g, std::move(table_[index(g)])});
  return others;
}

void SummaryTree::look_at(const Summary& here, std::vector<Near> candidates) {
  const BoundaryTree boundary(here.balls, opening_);
  near_.clear();
  for (Near& candidate : candidates) {
    if (candidate.summary.empty()) continue;
    if (here.empty() || are_far(here, boundary, candidate.summary, opening_))
      far_.push_back(std::move(candidate.summary));
    else
      near_.push_back(std::move(candidate));
  }
}

}  // namespace treejet
