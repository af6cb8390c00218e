#include "forces/distributed/chain_decomposition.hpp"

#include <cmath>
#include <limits>

namespace treejet {

namespace {
constexpr int least_share = 4;
}

ChainDecomposition::ChainDecomposition(int beads, const Ranks& ranks, Ends ends)
    : ranks_(ranks), ends_(ends) {
  cut(beads);
}

/// The beads of a rank that is not behind the end.
static int fair_share(int beads, int ranks) {
  return std::max(least_share, (beads + ranks - 1) / ranks);
}

void ChainDecomposition::cut(int beads) {
  const std::int64_t share = fair_share(beads, ranks_.size());
  layout_.ends = ends_;
  layout_.borders.clear();
  for (int k = 0; k <= ranks_.size(); ++k)
    layout_.borders.push_back(static_cast<int>(std::min<std::int64_t>(beads, k * share)));
}

int ChainDecomposition::neighbour(int step) const {
  if (own().size() == 0) return -1;
  for (int rank = ranks_.rank() + step; rank >= 0 && rank < ranks_.size(); rank += step)
    if (layout_.own(rank).size() > 0) return rank;
  return -1;
}

Rows ChainDecomposition::own() const {
  const Stretch mine = layout_.own(ranks_.rank());
  const int begin = mine.size() > 0 ? place_of(mine.first, layout_.here(ranks_.rank())) : 0;
  return {begin, begin + mine.size()};
}

std::pair<Eigen::Index, Eigen::Index> ChainDecomposition::own_rows(Eigen::Index) const {
  return {own().first, own().last};
}

std::vector<int> ChainDecomposition::rows() const {
  return treejet::numbers(layout_.here(ranks_.rank()));
}

IdColumn ChainDecomposition::numbers(const Jet<3>& jet) const {
  if (jet.id.size() > 0) return jet.id - 1;
  const std::vector<int> all = rows();
  return jet.removed + Eigen::Map<const Eigen::ArrayXi>(all.data(), std::ssize(all)).cast<std::int64_t>();
}

/// What is not a number counts as infinite: a maximum would let it pass.
double ChainDecomposition::greatest(double error) const {
  return ranks_.greatest(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
}

void ChainDecomposition::add_up(Eigen::Ref<Eigen::ArrayXd> numbers) const {
  ranks_.sum({numbers.data(), static_cast<std::size_t>(numbers.size())});
}

/// To their holders, too: a sum turns -0 into 0.
void ChainDecomposition::share_ends(Eigen::Ref<Eigen::ArrayXXd> table) const {
  const std::vector<Stretch> here = layout_.here(ranks_.rank());
  const std::vector<int> ends = treejet::numbers(layout_.at_ends());
  const Stretch mine = layout_.own(ranks_.rank());
  Eigen::ArrayXXd shared = Eigen::ArrayXXd::Zero(table.cols(), static_cast<Eigen::Index>(ends.size()));
  for (Eigen::Index k = 0; const int bead : ends) {
    if (bead >= mine.first && bead < mine.last) shared.col(k) = table.row(place_of(bead, here)).transpose();
    ++k;
  }
  ranks_.sum({shared.data(), static_cast<std::size_t>(shared.size())});
  for (Eigen::Index k = 0; const int bead : ends)
    table.row(place_of(bead, here)) = shared.col(k++).transpose();
}

/// The new bead, a row of every rank so far, belongs to the one that held the youngest.
void ChainDecomposition::after_release(Jet<3>& jet) {
  layout_.add_youngest();
  ++changes_;
  Layout had = layout_;
  ++had.ends.young;
  arrange(jet, had);
  recut_if_due(jet);
}

void ChainDecomposition::after_removal(Jet<3>& jet) {
  layout_.drop_oldest();
  ++changes_;
  if (total() == 0) return;
  Layout had = layout_;
  --had.ends.old;
  arrange(jet, had);
  recut_if_due(jet);
}

/// An arriving bead is looked at together with the one above it: both on one rank.
bool ChainDecomposition::out_of_balance() const {
  const int share = fair_share(total(), ranks_.size());
  return layout_.most_own() > share + share / 5 + 1 ||
         (total() > 1 && layout_.own(layout_.holder(0)).size() < 2);
}

void ChainDecomposition::recut_if_due(Jet<3>& jet) {
  if (!out_of_balance()) return;
  const Layout had = layout_;
  cut(total());
  arrange(jet, had);
  ++recuts_;
}

/// Every element belongs to the bead at its lower end.
double ChainDecomposition::path_length(const State<3>& y, const Vec<3>& nozzle) const {
  const Rows own = this->own();
  Ranks::Messages messages(index(ranks_.size()));
  if (const int to = older(); to >= 0) {
    const Vec<3> r = position<3>(y, own.first);
    messages[index(to)] = {r[0], r[1], r[2]};
  }
  const Ranks::Messages received = ranks_.exchange(messages);
  double length = 0;
  if (own.size() > 0) {
    const int from = younger();
    const Vec<3> end = from < 0 ? nozzle : Vec<3>(received[index(from)].data());
    length = treejet::path_length<3>(y.middleRows(own.first, own.size()), end);
  }
  ranks_.sum({&length, 1});
  return length;
}

}  // namespace treejet
