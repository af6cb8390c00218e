#include "core/base/error.hpp"
#include "core/jet/saved_chain.hpp"
#include "forces/distributed/chain_decomposition.hpp"

namespace treejet {

namespace {

/// Beads that are on their way to a file at a time: a few MB.
constexpr int portion_beads = 16'384;

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
    some.jet.born = jet.born;
    some.jet.held = jet.held;
    some.jet.last_release = jet.last_release;
    set_rows(some.jet, n, jet.y.cols());
    copy_beads(jet, jet.y, {row, row + n}, some.jet, 0);
    some.jet.removed = jet.removed + beads.first;
    if (jet.slope.rows() == jet.y.rows()) {
      some.jet.slope = jet.slope.middleRows(row, n);
      some.carried = carried_(row, n);
    }
  }
  return ranks_.to_first(rank, Archive::bytes_of(some));
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
  set_rows(jet, 0, saved.columns);
  jet.slope.resize(0, saved.columns);
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
    std::string own;
    Archive archive([&own](std::string_view piece) { own += piece; });
    if (own_state_ && rank == ranks_.rank()) own_state_(archive);
    const std::string bytes = ranks_.to_first(rank, std::move(own));
    if (ranks_.first()) write({rank, 0, bytes});
  }
}

void ChainDecomposition::read(Jet<3>& jet, const ReadRecords& records) {
  const std::vector<Stretch> here = layout_.here(ranks_.rank());
  const Eigen::Index n = place_of(total(), here), columns = jet.y.cols();
  Eigen::ArrayXXd carried(n, carried_(0, 0).cols());
  set_rows(jet, n, columns);
  jet.slope.resize(n, columns);
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
    if (some.jet.id.size() != (jet.born > 0 ? record.count : 0))
      throw FileError("the checkpoint has beads without an id");
    if (some.carried.cols() != carried.cols() || (carried.cols() > 0 && some.carried.rows() != record.count))
      throw FileError("the checkpoint remembers less of its beads than of the jet");
    for (const Stretch& part : parts_here(record.first, record.count)) {
      const int row = place_of(part.first, here), from = part.first - int(record.first), m = part.size();
      copy_beads(some.jet, some.jet.y, {from, from + m}, jet, row);
      jet.slope.middleRows(row, m) = some.jet.slope.middleRows(from, m);
      if (carried.cols() > 0) carried.middleRows(row, m) = some.carried.middleRows(from, m);
      found += m;
    }
  });
  if (found != n) throw FileError("the checkpoint lacks beads of the jet");
  set_carried_(carried);
  ++changes_;
}

}  // namespace treejet
