#include "forces/distributed/chain_decomposition.hpp"

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/jet/saved_chain.hpp"

namespace treejet {

namespace {

constexpr int least_share = 4;
/// Beads that are on their way to a file at a time: a few MB.
constexpr int portion_beads = 16'384;

/// Beads on their way, a column each: state, mass, charge, volume, what is carried along.
using Beads = Eigen::ArrayXXd;

Beads beads_of(const Jet<3>& jet, const Eigen::ArrayXXd& carried) {
  const Eigen::Index n = jet.size(), columns = jet.y.cols();
  Beads all(columns + static_cast<Eigen::Index>(bead_constants.size()) + carried.cols(), n);
  all.topRows(columns) = jet.y.transpose();
  Eigen::Index word = columns;
  for (auto each : bead_constants) all.row(word++) = (jet.*each).transpose();
  all.bottomRows(carried.cols()) = carried.transpose();
  return all;
}

void set_beads(Jet<3>& jet, const Beads& all) {
  Eigen::Index word = jet.y.cols();
  jet.y = all.topRows(word).transpose();
  for (auto each : bead_constants) jet.*each = all.row(word++).transpose();
}

/// Numbers of these beads.
std::vector<int> one_by_one(const std::vector<Stretch>& stretches) {
  std::vector<int> all;
  for (const Stretch& s : stretches)
    for (int i = s.first; i < s.last; ++i) all.push_back(i);
  return all;
}

}  // namespace

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
  return one_by_one(layout_.here(ranks_.rank()));
}

IdColumn ChainDecomposition::numbers(const Jet<3>& jet) const {
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
  const std::vector<int> ends = one_by_one(layout_.at_ends());
  const Stretch mine = layout_.own(ranks_.rank());
  Beads shared = Beads::Zero(table.cols(), static_cast<Eigen::Index>(ends.size()));
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
  Layout had = layout_;
  ++had.ends.young;
  arrange(jet, had);
  recut_if_due(jet);
}

void ChainDecomposition::after_removal(Jet<3>& jet) {
  layout_.drop_oldest();
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

/// From the rows of another layout to those of this one: every rank knows what each lacks, and sends what is
/// its own of that.
void ChainDecomposition::arrange(Jet<3>& jet, const Layout& had) {
  const int me = ranks_.rank();
  const std::vector<Stretch> mine = had.here(me);
  const Beads beads = beads_of(jet, carried_(0, jet.size()));
  const auto lacking = [&](int rank) { return without(layout_.here(rank), had.here(rank)); };
  bool any = false;
  Ranks::Messages messages(index(ranks_.size()));
  for (int rank = 0; rank < ranks_.size(); ++rank)
    for (const Stretch& s : lacking(rank)) {
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

  const std::vector<int> wanted = rows();
  const Eigen::Index words = beads.rows();
  Beads all(words, static_cast<Eigen::Index>(wanted.size()));
  const double* next = received.data();
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    const int bead = wanted[static_cast<std::size_t>(k)];
    const bool here = std::any_of(mine.begin(), mine.end(),
                                  [&](const Stretch& s) { return bead >= s.first && bead < s.last; });
    if (here) {
      all.col(k) = beads.col(place_of(bead, mine));
    } else {
      all.col(k) = Eigen::Map<const Eigen::ArrayXd>(next, words);
      next += words;
    }
  }
  set_beads(jet, all);
  set_carried_(all.bottomRows(words - jet.y.cols() - Eigen::Index{bead_constants.size()}).transpose());
}

void ChainDecomposition::take(Jet<3>& jet, const Jet<3>& all) {
  cut(static_cast<int>(all.size()));
  const std::vector<int> here = rows();
  jet = without_beads(all);
  jet.y = all.y(here, Eigen::all);
  for (auto each : bead_constants) jet.*each = (all.*each)(here);
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

namespace {

/// All beads up to `most`, in the order in which files have them.
void for_each_portion(const Layout& layout, std::int64_t most,
                      const std::function<void(int rank, Stretch beads)>& f) {
  for (int rank = 0; rank < layout.ranks(); ++rank) {
    const auto end = static_cast<int>(std::min<std::int64_t>(layout.own(rank).last, most));
    for (int begin = layout.own(rank).first; begin < end; begin += portion_beads)
      f(rank, {begin, std::min(begin + portion_beads, end)});
  }
}

}  // namespace

/// Of a rank's beads: with slopes, and what is carried along, if the jet has slopes.
std::string ChainDecomposition::portion(const Jet<3>& jet, int rank, Stretch beads) const {
  SavedBeads<3> some;
  if (rank == ranks_.rank()) {
    const int row = own().first + beads.first - layout_.own(rank).first, n = beads.size();
    some.jet.t = jet.t;
    some.jet.y = jet.y.middleRows(row, n);
    for (auto each : bead_constants) some.jet.*each = (jet.*each).segment(row, n);
    some.jet.removed = jet.removed + beads.first;
    if (jet.slope.rows() == jet.y.rows()) {
      some.jet.slope = jet.slope.middleRows(row, n);
      some.carried = carried_(row, n);
    }
  }
  Archive archive;
  archive(some);
  return ranks_.to_first(rank, std::move(archive).bytes());
}

void ChainDecomposition::in_portions(const Jet<3>& jet, std::int64_t most,
                                     const std::function<void(const Jet<3>& some)>& take) const {
  for_each_portion(layout_, most, [&](int rank, Stretch beads) {
    const std::string bytes = portion(jet, rank, beads);
    if (!ranks_.first()) return;
    SavedBeads<3> some;
    Archive archive(bytes);
    archive(some);
    take(some.jet);
  });
}

void ChainDecomposition::visit(Jet<3>& jet, Archive& state) {
  SavedCut<3> saved{jet, jet.y.cols(), layout_.borders, recuts_};
  state(saved);
  if (!state.reading()) return;
  recuts_ = saved.recuts;
  cut(saved.borders.back());
  cut_as_saved_ = saved.borders.size() == layout_.borders.size();
  if (cut_as_saved_) layout_.borders = saved.borders;
  for (auto* table : {&jet.y, &jet.slope}) table->resize(0, saved.columns);
  for (auto each : bead_constants) (jet.*each).resize(0);
}

std::int64_t ChainDecomposition::records() const {
  std::int64_t count = ranks_.size();
  for_each_portion(layout_, total(), [&](int, Stretch) { ++count; });
  return count;
}

void ChainDecomposition::write(const Jet<3>& jet, const WriteRecord& write) const {
  for_each_portion(layout_, total(), [&](int rank, Stretch beads) {
    const std::string bytes = portion(jet, rank, beads);
    if (ranks_.first()) write({beads.first, beads.size(), bytes});
  });
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    Archive archive;
    if (own_state_ && rank == ranks_.rank()) own_state_(archive);
    const std::string bytes = ranks_.to_first(rank, std::move(archive).bytes());
    if (ranks_.first()) write({rank, 0, bytes});
  }
}

void ChainDecomposition::read(Jet<3>& jet, const ReadRecords& records) {
  const std::vector<Stretch> here = layout_.here(ranks_.rank());
  const Eigen::Index n = place_of(total(), here), columns = jet.y.cols();
  Eigen::ArrayXXd carried(n, carried_(0, 0).cols());
  for (auto* table : {&jet.y, &jet.slope}) table->resize(n, columns);
  for (auto each : bead_constants) (jet.*each).resize(n);
  Eigen::Index found = 0;
  const auto parts_here = [&](std::int64_t first, std::int64_t count) {
    std::vector<Stretch> parts;
    for (const Stretch& s : here) {
      const Stretch part = common(s, {static_cast<int>(first), static_cast<int>(first + count)});
      if (part.size() > 0) parts.push_back(part);
    }
    return parts;
  };
  const auto wanted = [&](std::int64_t first, std::int64_t count) {
    return count > 0 ? !parts_here(first, count).empty()
                     : cut_as_saved_ && own_state_ && first == ranks_.rank();
  };
  records(wanted, [&](const SubdomainRecord& record) {
    Archive archive(record.bytes);
    if (record.count == 0) return own_state_(archive), archive.expect_end();
    SavedBeads<3> some;
    archive(some);
    expect_complete(some, record.count, columns);
    if (some.carried.cols() != carried.cols() || (carried.cols() > 0 && some.carried.rows() != record.count))
      throw FileError("the checkpoint remembers less of its beads than of the jet");
    for (const Stretch& part : parts_here(record.first, record.count)) {
      const Eigen::Index row = place_of(part.first, here), from = part.first - record.first, m = part.size();
      jet.y.middleRows(row, m) = some.jet.y.middleRows(from, m);
      jet.slope.middleRows(row, m) = some.jet.slope.middleRows(from, m);
      for (auto each : bead_constants) (jet.*each).segment(row, m) = (some.jet.*each).segment(from, m);
      if (carried.cols() > 0) carried.middleRows(row, m) = some.carried.middleRows(from, m);
      found += m;
    }
  });
  if (found != n) throw FileError("the checkpoint lacks beads of the jet");
  set_carried_(carried);
}

}  // namespace treejet
