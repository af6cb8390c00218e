#include "forces/distributed/bead_moves.hpp"

namespace treejet {

Beads sent_by_others(const Ranks& ranks, const Layout& had, const Wanted& wanted, Eigen::Index words,
                     const PackedRows& packed) {
  const int me = ranks.rank();
  const std::vector<Stretch> mine = had.here(me);
  bool any = false;
  Ranks::Messages messages(index(ranks.size()));
  for (int rank = 0; rank < ranks.size(); ++rank)
    for (const Stretch& s : without(wanted(rank), had.here(rank))) {
      any = true;
      const Stretch mine_of_it = common(s, had.own(me));
      if (mine_of_it.size() == 0) continue;
      const int row = place_of(mine_of_it.first, mine);
      const Beads beads = packed({row, row + mine_of_it.size()});
      messages[index(rank)].insert(messages[index(rank)].end(), beads.data(), beads.data() + beads.size());
    }
  std::vector<double> received;  // ascending, as the ranks are
  if (any)
    for (const auto& message : ranks.exchange(messages))
      received.insert(received.end(), message.begin(), message.end());
  return Eigen::Map<const Beads>(received.data(), words, std::ssize(received) / words);
}

void for_each_wanted(const std::vector<Stretch>& wanted, const std::vector<Stretch>& had,
                     const std::function<void(Rows, int)>& keep, const std::function<void(Rows, int)>& take) {
  int row = 0, taken = 0;
  for (const Stretch& w : wanted)
    for (int bead = w.first, end = 0; bead < w.last; bead = end) {
      const auto next = std::find_if(had.begin(), had.end(), [&](const Stretch& s) { return bead < s.last; });
      const bool here = next != had.end() && bead >= next->first;
      end = next == had.end() ? w.last : std::min(w.last, here ? next->last : next->first);
      const int count = end - bead, from = here ? place_of(bead, had) : taken;
      (here ? keep : take)({from, from + count}, row);
      if (!here) taken += count;
      row += count;
    }
}

Jet<3> brought(const Ranks& ranks, const Jet<3>& jet, const Layout& had, const Wanted& wanted) {
  const Beads others = sent_by_others(ranks, had, wanted, words_of_bead(jet),
                                      [&](Rows rows) { return packed(jet, jet.y, rows); });
  const std::vector<Stretch> mine = wanted(ranks.rank());
  Jet<3> all = without_beads(jet);
  set_rows(all, place_of(had.total(), mine), jet.y.cols());
  for_each_wanted(
      mine, had.here(ranks.rank()), [&](Rows rows, int to) { copy_beads(jet, jet.y, rows, all, to); },
      [&](Rows columns, int to) { unpack(others.middleCols(columns.first, columns.size()), all, to); });
  return all;
}

}  // namespace treejet
