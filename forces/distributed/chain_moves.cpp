#include "forces/distributed/chain_decomposition.hpp"

namespace treejet {

namespace {

using Beads = ChainDecomposition::Beads;

Eigen::Index words_of_bead(const Jet<3>& jet) {
  return jet.y.cols() + Eigen::Index{bead_constants.size()} + (jet.id.size() > 0 ? 1 : 0);
}

/// An id is exact as a floating-point number up to 2^53.
Beads beads_of(const Jet<3>& jet, const Eigen::ArrayXXd& carried) {
  Beads all(words_of_bead(jet) + carried.cols(), jet.size());
  all.topRows(jet.y.cols()) = jet.y.transpose();
  Eigen::Index word = jet.y.cols();
  for (auto each : bead_constants) all.row(word++) = (jet.*each).transpose();
  if (jet.id.size() > 0) all.row(word++) = jet.id.cast<double>().transpose();
  all.bottomRows(carried.cols()) = carried.transpose();
  return all;
}

void set_beads(Jet<3>& jet, const Beads& all) {
  if (all.cols() == 0) {  // a row of no beads has no address to count from
    jet = without_beads(jet);
    return;
  }
  Eigen::Index word = jet.y.cols();
  const bool ids = jet.id.size() > 0;
  jet.y = all.topRows(word).transpose();
  for (auto each : bead_constants) jet.*each = all.row(word++).transpose();
  if (ids) jet.id = all.row(word).transpose().cast<std::int64_t>();
}

}  // namespace

/// Every rank knows what each lacks, and sends what is its own of that.
Beads ChainDecomposition::wanted_beads(const Beads& beads, const Layout& had, const Wanted& wanted) const {
  const int me = ranks_.rank();
  const std::vector<Stretch> mine = had.here(me);
  bool any = false;
  Ranks::Messages messages(index(ranks_.size()));
  for (int rank = 0; rank < ranks_.size(); ++rank)
    for (const Stretch& s : without(wanted(rank), had.here(rank))) {
      any = true;
      const Stretch mine_of_it = common(s, had.own(me));
      if (mine_of_it.size() == 0) continue;
      const double* const from = beads.col(place_of(mine_of_it.first, mine)).data();
      messages[index(rank)].insert(messages[index(rank)].end(), from,
                                   from + mine_of_it.size() * beads.rows());
    }
  std::vector<double> received;  // ascending, as the ranks are
  if (any)
    for (const auto& message : ranks_.exchange(messages))
      received.insert(received.end(), message.begin(), message.end());

  const std::vector<int> asked = treejet::numbers(wanted(me));
  Beads all(beads.rows(), static_cast<Eigen::Index>(asked.size()));
  const double* next = received.data();
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    const int bead = asked[static_cast<std::size_t>(k)];
    const bool here = std::any_of(mine.begin(), mine.end(),
                                  [&](const Stretch& s) { return bead >= s.first && bead < s.last; });
    if (here) {
      all.col(k) = beads.col(place_of(bead, mine));
    } else {
      all.col(k) = Eigen::Map<const Eigen::ArrayXd>(next, beads.rows());
      next += beads.rows();
    }
  }
  return all;
}

/// From the rows of another layout to those of this one.
void ChainDecomposition::arrange(Jet<3>& jet, const Layout& had) {
  const Eigen::Index words = words_of_bead(jet);
  const Beads all = wanted_beads(beads_of(jet, carried_(0, jet.size())), had,
                                 [this](int rank) { return layout_.here(rank); });
  set_beads(jet, all);
  set_carried_(all.bottomRows(all.rows() - words).transpose());
}

/// The own beads and some beyond, as far as the chain goes.
Jet<3> ChainDecomposition::part(const Jet<3>& jet, int beyond) const {
  const auto wanted = [&](int rank) -> std::vector<Stretch> {
    const Stretch own = layout_.own(rank);
    if (own.size() == 0) return {};
    return {{std::max(own.first - beyond, 0), std::min(own.last + beyond, total())}};
  };
  Jet<3> part = jet;
  set_beads(part, wanted_beads(beads_of(jet, Eigen::ArrayXXd(jet.size(), 0)), layout_, wanted));
  return part;
}

/// A number a bead, of all beads on all ranks.
Eigen::ArrayXXd ChainDecomposition::gathered(const Eigen::Ref<const Eigen::ArrayXXd>& table) const {
  Eigen::ArrayXXd all(total(), table.cols());
  const Stretch mine = layout_.own(ranks_.rank());
  all.middleRows(mine.first, mine.size()) = table.middleRows(own().first, mine.size());
  std::vector<double*> columns;
  for (Eigen::Index k = 0; k < all.cols(); ++k) columns.push_back(all.col(k).data());
  ranks_.gather(columns, layout_.borders);
  return all;
}

const Eigen::ArrayXd& ChainDecomposition::all_volumes(const Jet<3>& jet) const {
  if (!shares_volumes_) return jet.volume;
  if (volumes_since_ != changes_) volumes_ = gathered(jet.volume);
  volumes_since_ = changes_;
  return volumes_;
}

/// All of it on all ranks.
Jet<3> ChainDecomposition::undivided(const Jet<3>& jet) const {
  Jet<3> all = jet;
  set_beads(all, gathered(beads_of(jet, Eigen::ArrayXXd(jet.size(), 0)).transpose()).transpose());
  return all;
}

/// Of a jet that is here whole, what is to be here.
void ChainDecomposition::take_rows(Jet<3>& jet, const Jet<3>& all) const {
  const std::vector<int> here = rows();
  jet = without_beads(all);
  jet.y = all.y(here, Eigen::all);
  for (auto each : bead_constants) jet.*each = (all.*each)(here);
  if (all.id.size() > 0) jet.id = all.id(here);
}

void ChainDecomposition::take(Jet<3>& jet, const Jet<3>& all) {
  cut(static_cast<int>(all.size()));
  take_rows(jet, all);
  ++changes_;
}

Refinement ChainDecomposition::refinement(const Jet<3>& jet, const Spacing<3>& spacing) const {
  const bool content = spacing.content(part(jet, /*beyond*/ 3));
  if (ranks_.greatest(content ? 0 : 1) == 0) return {};
  return spacing.refinement(undivided(jet));
}

void ChainDecomposition::refine(Jet<3>& jet, const Refinement& refinement) {
  Jet<3> all = undivided(jet);
  treejet::refine(all, refinement);
  for (const RefinementPass& pass : refinement) layout_.refine(pass);
  if (out_of_balance()) {
    cut(total());
    ++recuts_;
  }
  take_rows(jet, all);
  ++changes_;
}

}  // namespace treejet
