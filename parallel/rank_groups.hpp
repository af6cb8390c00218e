#pragma once
/// Ranks in groups of 1, 2, 4, 8 ...: group g of level l are the ranks from g 2^l on, 2^l of them or as many
/// as are left. Groups 2g and 2g+1 make up group g of the next level; on the last level one holds all.
///
/// When two groups write to each other every rank gets a message from the other group, from the rank that
/// stands where it stands itself; a smaller group starts over. So a rank sends as much in few ranks as in
/// many.

#include <vector>

namespace treejet {

class RankGroups {
 public:
  explicit RankGroups(int ranks) : ranks_(ranks) {
    while (1 << levels_ < ranks) ++levels_;
  }

  /// Levels below the one on which one group holds all.
  int levels() const { return levels_; }
  static int of(int rank, int level) { return rank >> level; }
  bool exists(int level, int group) const { return group << level < ranks_; }
  /// How many there are.
  int count(int level) const { return ((ranks_ - 1) >> level) + 1; }

  /// The groups of a lower level that make up a group.
  std::vector<int> within(int level, int group, int lower) const {
    std::vector<int> some;
    const int below = level - lower;
    for (int g = group << below; g < (group + 1) << below && exists(lower, g); ++g) some.push_back(g);
    return some;
  }

  /// The ranks of group `other` to whom a rank writes that is in another of the level, and the one of it that
  /// writes to that rank.
  std::vector<int> readers(int level, int rank, int other) const {
    std::vector<int> some;
    const int own = of(rank, level) << level;
    for (int k = rank - own; k < size(level, other); k += size(level, of(rank, level)))
      some.push_back((other << level) + k);
    return some;
  }
  int writer(int level, int rank, int other) const {
    const int own = of(rank, level) << level;
    return (other << level) + (rank - own) % size(level, other);
  }

 private:
  int size(int level, int group) const {
    const int first = group << level, all = 1 << level;
    return first + all <= ranks_ ? all : ranks_ - first;
  }

  int ranks_, levels_ = 0;
};

}  // namespace treejet
