#include "forces/distributed/bead_moves.hpp"
#include "forces/distributed/chain_decomposition.hpp"
#include "forces/distributed/own_beads.hpp"

namespace treejet {

/// From the rows of another layout to those of this one.
void ChainDecomposition::arrange(Jet<3>& jet, const Layout& had) {
  const Eigen::ArrayXXd carried = carried_(0, jet.size());
  const bool carries = carried.cols() > 0;  // no place is named in a table that has no memory
  const Eigen::Index words = words_of_bead(jet);
  const Beads others = sent_by_others(
      ranks_, had, [this](int rank) { return layout_.here(rank); }, words + carried.cols(),
      [&](Rows rows) {
        Beads beads(words + carried.cols(), rows.size());
        beads.topRows(words) = packed(jet, jet.y, rows);
        if (carries)
          beads.bottomRows(carried.cols()) = carried.middleRows(rows.first, rows.size()).transpose();
        return beads;
      });
  const int me = ranks_.rank();
  const std::vector<Stretch> here = layout_.here(me);
  Jet<3> all = without_beads(jet);
  set_rows(all, place_of(total(), here), jet.y.cols());
  Eigen::ArrayXXd carried_now(all.size(), carried.cols());
  for_each_wanted(
      here, had.here(me),
      [&](Rows rows, int to) {
        copy_beads(jet, jet.y, rows, all, to);
        if (carries) carried_now.middleRows(to, rows.size()) = carried.middleRows(rows.first, rows.size());
      },
      [&](Rows columns, int to) {
        const auto beads = others.middleCols(columns.first, columns.size());
        unpack(beads.topRows(words), all, to);
        if (carries)
          carried_now.middleRows(to, columns.size()) = beads.bottomRows(carried.cols()).transpose();
      });
  jet = std::move(all);
  set_carried_(carried_now);
}

const Eigen::ArrayXd& ChainDecomposition::all_volumes(const Jet<3>& jet) const {
  if (!shares_volumes_) return jet.volume;
  if (volumes_since_ == changes_) return volumes_;
  const Stretch mine = layout_.own(ranks_.rank());
  volumes_.resize(total());
  volumes_.segment(mine.first, mine.size()) = jet.volume.segment(own().first, mine.size());
  double* const column = volumes_.data();
  ranks_.gather({&column, 1}, layout_.borders);
  volumes_since_ = changes_;
  return volumes_;
}

void ChainDecomposition::take(Jet<3>& jet, const Jet<3>& all) {
  cut(static_cast<int>(all.size()));
  const std::vector<int> here = rows();
  jet = without_beads(all);
  jet.y = all.y(here, Eigen::all);
  for (auto each : bead_constants) jet.*each = (all.*each)(here);
  if (all.id.size() > 0) jet.id = all.id(here);
  ++changes_;
}

Refinement ChainDecomposition::refinement(const Jet<3>& jet, const Spacing<3>& spacing) const {
  OwnBeads trial(ranks_, jet, layout_);
  const bool content = spacing.content(trial.with_neighbours(/*beyond*/ 3));
  if (ranks_.greatest(content ? 0 : 1) == 0) return {};
  return spacing.refinement([&](RefinementPass::Kind kind) { return trial.asking(spacing, kind); },
                            [&](const RefinementPass& pass) { trial.refine(pass); });
}

void ChainDecomposition::refine(Jet<3>& jet, const Refinement& refinement, std::span<Jet<3>> alike) {
  const auto refined = [&](const Jet<3>& one) {
    OwnBeads own(ranks_, one, layout_);
    for (const RefinementPass& pass : refinement) own.refine(pass);
    return own;
  };
  std::vector<OwnBeads> all = {refined(jet)};
  for (const Jet<3>& one : alike) all.push_back(refined(one));
  const Layout had = all[0].layout();
  layout_.borders = had.borders;
  if (out_of_balance()) {
    cut(total());
    ++recuts_;
  }
  const auto rows_here = [&](const OwnBeads& one) {
    return brought(ranks_, one.jet(), had, [this](int rank) { return layout_.here(rank); });
  };
  jet = rows_here(all[0]);
  for (std::size_t k = 0; k < alike.size(); ++k) alike[k] = rows_here(all[k + 1]);
  ++changes_;
}

}  // namespace treejet
