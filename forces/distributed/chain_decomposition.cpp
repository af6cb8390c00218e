#include "forces/distributed/chain_decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace treejet {

namespace {

constexpr int least_share = 4;

/// Beads on their way, a column each: state, mass, charge, volume.
using Beads = Eigen::ArrayXXd;
constexpr auto constants = {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume};

Eigen::Index words(const Jet<3>& jet) {
  return jet.y.cols() + static_cast<Eigen::Index>(constants.size());
}

Beads beads_of(const Jet<3>& jet, Rows rows) {
  Beads some(words(jet), rows.size());
  Eigen::Index word = jet.y.cols();
  some.topRows(word) = jet.y.middleRows(rows.first, rows.size()).transpose();
  for (auto each : constants) some.row(word++) = (jet.*each).segment(rows.first, rows.size()).transpose();
  return some;
}

void set_beads(Jet<3>& jet, const Beads& all) {
  Eigen::Index word = jet.y.cols();
  jet.y = all.topRows(word).transpose();
  for (auto each : constants) jet.*each = all.row(word++).transpose();
}

Beads joined(const std::vector<Beads>& parts) {
  Eigen::Index count = 0;
  for (const Beads& part : parts) count += part.cols();
  Beads all(parts.front().rows(), count);
  for (Eigen::Index at = 0; const Beads& part : parts) {
    all.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  return all;
}

std::vector<double> letter(const Beads& some) {
  return {some.data(), some.data() + some.size()};
}

Beads read(const std::vector<double>& letter, Eigen::Index words) {
  return Eigen::Map<const Beads>(letter.data(), words, static_cast<Eigen::Index>(letter.size()) / words);
}

}  // namespace

ChainDecomposition::ChainDecomposition(int beads, const Ranks& ranks) : ranks_(ranks) {
  cut(beads);
}

/// The beads of a rank that is not behind the end.
int ChainDecomposition::fair_share(int beads) const {
  return std::max(least_share, (beads + ranks_.size() - 1) / ranks_.size());
}

void ChainDecomposition::cut(int beads) {
  const int share = fair_share(beads);
  counts_.resize(index(ranks_.size()));
  for (int k = 0; k < ranks_.size(); ++k)
    counts_[index(k)] = static_cast<int>(std::clamp<std::int64_t>(beads - std::int64_t{k} * share, 0, share));
}

/// The number of the first bead of a rank.
int ChainDecomposition::first(int rank) const {
  return std::accumulate(counts_.begin(), counts_.begin() + rank, 0);
}

/// The rank that holds the oldest (0) or youngest (1) bead; -1 if there is none.
int ChainDecomposition::end(int which) const {
  for (int k = 0; k < ranks_.size(); ++k) {
    const int rank = which == 0 ? k : ranks_.size() - 1 - k;
    if (counts_[index(rank)] > 0) return rank;
  }
  return -1;
}

int ChainDecomposition::neighbour(int step) const {
  if (own().size() == 0) return -1;
  for (int rank = ranks_.rank() + step; rank >= 0 && rank < ranks_.size(); rank += step)
    if (counts_[index(rank)] > 0) return rank;
  return -1;
}

Rows ChainDecomposition::own() const {
  const int count = counts_[index(ranks_.rank())];
  const int begin = count > 0 && !has_oldest() ? 1 : 0;
  return {begin, begin + count};
}

std::vector<int> ChainDecomposition::rows() const {
  std::vector<int> numbers;
  const int begin = first(ranks_.rank()), own = counts_[index(ranks_.rank())];
  if (total() > 0 && !has_oldest()) numbers.push_back(0);
  for (int i = begin; i < begin + own; ++i) numbers.push_back(i);
  if (total() > 1 && !has_youngest()) numbers.push_back(total() - 1);
  return numbers;
}

/// What is not a number counts as infinite: a maximum would let it pass.
double ChainDecomposition::greatest(double error) const {
  return ranks_.greatest(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
}

/// The new bead belongs to the rank that held the youngest one; for the others it takes the place of the copy
/// of that, unless this was the copy of the oldest one, too.
void ChainDecomposition::after_release(Jet<3>& jet) {
  const int n = static_cast<int>(jet.size());
  if (!has_youngest() && total() > 1)
    set_beads(jet, joined({beads_of(jet, {0, n - 2}), beads_of(jet, {n - 1, n})}));
  ++counts_[index(end(1))];
  if (out_of_balance()) recut(jet);
}

/// All but the rank that holds it need a copy of what is now the oldest bead, unless it is the youngest one,
/// too.
void ChainDecomposition::after_removal(Jet<3>& jet) {
  --counts_[index(end(0))];
  if (total() == 0) return;
  Beads oldest = Beads::Zero(words(jet), 1);
  if (has_oldest()) oldest = beads_of(jet, {0, 1});
  ranks_.sum({oldest.data(), static_cast<std::size_t>(oldest.size())});
  if (!has_oldest() && total() > 1)
    set_beads(jet, joined({oldest, beads_of(jet, {0, static_cast<int>(jet.size())})}));
  if (out_of_balance()) recut(jet);
}

/// An arriving bead is looked at together with the one above it: both on one rank.
bool ChainDecomposition::out_of_balance() const {
  const int most = *std::max_element(counts_.begin(), counts_.end());
  const int share = fair_share(total());
  return most > share + share / 5 + 1 || (total() > 1 && counts_[index(end(0))] < 2);
}

void ChainDecomposition::recut(Jet<3>& jet) {
  const int n = static_cast<int>(jet.size()), me = ranks_.rank();
  const Beads oldest = beads_of(jet, {0, 1}), youngest = beads_of(jet, {n - 1, n});
  const Rows mine = own();
  const int had = first(me);
  cut(total());
  Ranks::Letters letters(index(ranks_.size()));
  for (int k = 0; k < ranks_.size(); ++k) {
    const int begin = std::max(had, first(k)), end = std::min(had + mine.size(), first(k + 1));
    if (begin < end)
      letters[index(k)] = letter(beads_of(jet, {mine.first + begin - had, mine.first + end - had}));
  }
  std::vector<Beads> parts;
  if (!has_oldest()) parts.push_back(oldest);
  for (const auto& received : ranks_.exchange(letters)) parts.push_back(read(received, words(jet)));
  if (!has_youngest()) parts.push_back(youngest);
  set_beads(jet, joined(parts));
  ++recuts_;
}

Jet<3> ChainDecomposition::whole(Jet<3>&& jet) const {
  Ranks::Letters letters(index(ranks_.size()));
  letters[0] = letter(beads_of(jet, own()));
  std::vector<Beads> parts;
  for (const auto& received : ranks_.exchange(letters)) parts.push_back(read(received, words(jet)));
  if (ranks_.first()) set_beads(jet, joined(parts));
  return std::move(jet);
}

}  // namespace treejet
