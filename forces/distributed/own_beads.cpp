#include "forces/distributed/own_beads.hpp"

namespace treejet {

namespace {

using Index = Eigen::Index;
using Kind = RefinementPass::Kind;

Layout without_ends(Layout layout) {
  layout.ends = {0, 0};
  return layout;
}

Stretch widened(Stretch own, int beyond, int total) {
  if (own.size() == 0) return own;
  return {std::max(own.first - beyond, 0), std::min(own.last + beyond, total)};
}

Jet<3> own_rows(const Ranks& ranks, const Jet<3>& jet, const Layout& layout) {
  return brought(ranks, jet, layout, [&](int rank) { return united({layout.own(rank)}); });
}

/// What of a pass concerns these beads alone, ascending.
std::vector<Index> within(const RefinementPass& pass, Stretch beads) {
  const int below = pass.kind == Kind::split ? 0 : 1;
  std::vector<Index> rows;
  for (const Index row : pass.rows)
    if (row - below >= beads.first && row + 1 < beads.last) rows.push_back(row);
  return rows;
}

Index count_below(const std::vector<Index>& rows, Index end) {
  return std::lower_bound(rows.begin(), rows.end(), end) - rows.begin();
}

}  // namespace

OwnBeads::OwnBeads(const Ranks& ranks, const Jet<3>& jet, const Layout& layout)
    : ranks_(ranks), layout_(without_ends(layout)), jet_(own_rows(ranks, jet, layout)) {}

Jet<3> OwnBeads::with_neighbours(int beyond) const {
  const int total = layout_.total();
  Jet<3> part = brought(ranks_, jet_, layout_,
                        [&](int rank) { return united({widened(layout_.own(rank), beyond, total)}); });
  const Stretch here = widened(own(), beyond, total);
  part.from_oldest = here.first == 0;
  part.to_youngest = here.last == total;
  return part;
}

std::vector<Index> OwnBeads::asking(const Spacing<3>& spacing, Kind kind) const {
  constexpr int first_try = 8;
  std::optional<std::vector<Index>> found;
  for (int beyond = first_try; !found; beyond *= 2) {
    const Jet<3> part = with_neighbours(beyond);
    const int first = own().first, before = first - widened(own(), beyond, layout_.total()).first;
    found =
        own().size() > 0 ? spacing.asking(kind, part, {before, before + own().size()}) : std::vector<Index>();
    if (ranks_.greatest(found ? 0 : 1) > 0) found.reset();
    if (!found) continue;
    for (Index& row : *found) row += first - before;
  }
  const std::vector<double> mine(found->begin(), found->end());
  std::vector<Index> all;
  for (const auto& message : ranks_.exchange(Ranks::Messages(index(ranks_.size()), mine)))
    all.insert(all.end(), message.begin(), message.end());
  return all;
}

void OwnBeads::refine(const RefinementPass& pass) {
  constexpr int beyond = 5;
  Jet<3> part = with_neighbours(beyond);
  const Stretch own = this->own(), here = widened(own, beyond, layout_.total());
  RefinementPass local{pass.kind, within(pass, here), pass.of_beads};
  const bool splits = pass.kind == Kind::split;
  if (splits && !local.rows.empty()) part.born += count_below(pass.rows, local.rows[0]);
  const Index changed_before = count_below(local.rows, own.first);
  for (Index& row : local.rows) row -= here.first;
  treejet::refine(part, local);
  layout_.refine(pass);

  const Index first = own.first - here.first + (splits ? changed_before : -changed_before);
  const int n = this->own().size();
  jet_ = without_beads(jet_);
  set_rows(jet_, n, part.y.cols());
  copy_beads(part, part.y, {int(first), int(first) + n}, jet_, 0);
  if (splits) jet_.born += std::ssize(pass.rows);
}

}  // namespace treejet
