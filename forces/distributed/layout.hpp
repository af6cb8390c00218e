#pragma once
/// Which beads of a chain stand on which rank, by number from the oldest on: the own ones of each rank, a
/// stretch, and copies of those at both ends of the chain.

#include <algorithm>
#include <vector>

#include "core/jet/refinement.hpp"

namespace treejet {

/// Beads first <= i < last.
struct Stretch {
  int first = 0, last = 0;
  int size() const { return std::max(last - first, 0); }
};

inline Stretch common(Stretch a, Stretch b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// Ascending, each bead once.
inline std::vector<Stretch> united(std::vector<Stretch> stretches) {
  std::sort(stretches.begin(), stretches.end(), [](Stretch a, Stretch b) { return a.first < b.first; });
  std::vector<Stretch> all;
  for (Stretch s : stretches) {
    if (!all.empty()) s.first = std::max(s.first, all.back().last);
    if (s.size() > 0) all.push_back(s);
  }
  return all;
}

/// What of `some` is not in `others`; both ascending.
inline std::vector<Stretch> without(const std::vector<Stretch>& some, const std::vector<Stretch>& others) {
  std::vector<Stretch> rest;
  for (Stretch s : some) {
    for (const Stretch& o : others) {
      if (common(s, o).size() == 0) continue;
      if (s.first < o.first) rest.push_back({s.first, o.first});
      s.first = o.last;
    }
    if (s.size() > 0) rest.push_back(s);
  }
  return rest;
}

/// Where a bead stands among some that follow each other; behind them if it is not one of them.
inline int place_of(int bead, const std::vector<Stretch>& stretches) {
  int before = 0;
  for (const Stretch& s : stretches) {
    if (bead < s.last) return before + bead - s.first;
    before += s.size();
  }
  return before;
}

/// Of these beads, one by one.
inline std::vector<int> numbers(const std::vector<Stretch>& stretches) {
  std::vector<int> all;
  for (const Stretch& s : stretches)
    for (int i = s.first; i < s.last; ++i) all.push_back(i);
  return all;
}

/// Beads at the ends of a chain of which every rank has copies.
struct Ends {
  int old = 1, young = 1;
};

struct Layout {
  std::vector<int> borders = {0};  ///< the first own bead of each rank, and the number of all
  Ends ends;

  int ranks() const { return static_cast<int>(borders.size()) - 1; }
  int total() const { return borders.back(); }
  Stretch own(int rank) const {
    return {borders[static_cast<std::size_t>(rank)], borders[static_cast<std::size_t>(rank) + 1]};
  }
  int most_own() const {
    int most = 0;
    for (int rank = 0; rank < ranks(); ++rank) most = std::max(most, own(rank).size());
    return most;
  }

  /// The rank whose own bead it is; -1 if there is none.
  int holder(int bead) const {
    if (bead < 0 || bead >= total()) return -1;
    return static_cast<int>(std::upper_bound(borders.begin(), borders.end(), bead) - borders.begin()) - 1;
  }

  std::vector<Stretch> at_ends() const { return united({old_end(), young_end()}); }
  /// At the ends or its own.
  std::vector<Stretch> here(int rank) const { return united({old_end(), own(rank), young_end()}); }

  /// One more bead at the nozzle, of the rank that has the youngest; one less at the collector.
  void add_youngest() {
    const int rank = holder(total() - 1);
    for (int k = rank + 1; k <= ranks(); ++k) ++borders[static_cast<std::size_t>(k)];
  }
  void drop_oldest() {
    const int rank = holder(0);
    for (int k = rank + 1; k <= ranks(); ++k) --borders[static_cast<std::size_t>(k)];
  }

  /// Beads stay with those that they come of: the half above a split element with the half below.
  void refine(const RefinementPass& pass) {
    for (int& border : borders) {
      const auto before = std::lower_bound(pass.rows.begin(), pass.rows.end(), border) - pass.rows.begin();
      border += static_cast<int>(pass.kind == RefinementPass::Kind::split ? before : -before);
    }
  }

 private:
  Stretch old_end() const { return {0, std::min(ends.old, total())}; }
  Stretch young_end() const { return {std::max(total() - ends.young, 0), total()}; }
};

}  // namespace treejet
