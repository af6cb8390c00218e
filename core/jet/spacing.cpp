#include "core/jet/spacing.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/multiples.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

namespace {

using Index = Eigen::Index;

constexpr Index left_alone = 3;     ///< youngest elements
constexpr double round_off = 1e-9;  ///< relative

/// The elements that join two beads.
struct Elements {
  Eigen::ArrayXd length, volume;
  Eigen::ArrayXd turn;  ///< curvature times length, with the larger curvature at its two beads
};

template <int D>
Elements elements(const Jet<D>& jet) {
  const Index n = std::max<Index>(jet.size() - 1, 0);
  Elements e{Eigen::ArrayXd(n), jet.volume.head(n), Eigen::ArrayXd::Zero(n)};
  Vec<D> before = Vec<D>::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vec<D> d = position<D>(jet.y, i) - position<D>(jet.y, i + 1), tangent = d.normalized();
    e.length[i] = d.norm();
    if (i > 0) {
      const double curvature = 2 * (tangent - before).norm() / (e.length[i - 1] + e.length[i]);
      for (const Index k : {i - 1, i}) e.turn[k] = std::max(e.turn[k], curvature * e.length[k]);
    }
    before = tangent;
  }
  return e;
}

/// Volume of the element that the oldest bead stands for beyond its own, half of which is its: none at a free
/// end of half a cell.
template <int D>
double beyond_oldest(const Jet<D>& jet) {
  return 2 * jet.mass[0] - jet.volume[0];
}

}  // namespace

template <int D>
Spacing<D>::Spacing(const Parameters& p, const Columns& added) {
  const Scales s = scales(p);
  constexpr double chord = 24;  // 1 - sin(c / 2) / (c / 2) = c^2 / 24
  if (p.refinement_threshold) longest_ = *p.refinement_threshold / s.length;
  if (p.refinement_tolerance) most_turn_ = std::sqrt(chord * *p.refinement_tolerance);
  every_ = p.refinement_every.value_or(0) / s.time;
  start_ = p.refinement_start / s.time;
  const double a = p.nozzle_cross / s.length;
  slender_ = 4 * a * a * groups(p).L_step;  // (2 a)^2 = 4 a_0^2 l_step V / l
  for (std::size_t k = 0; k < added.size(); ++k)
    if (added[k].of_bead) of_beads_.push_back(own_columns<D> + static_cast<Index>(k));
}

template <int D>
double Spacing<D>::next(double t) const {
  if (every_ == 0) return never;
  const double k = start_ / every_, first = std::ceil(k - multiple_round_off(k));
  return every_ * std::max(last_multiple(t, every_) + 1, first);
}

template <int D>
bool Spacing<D>::due(double t, bool has_released) const {
  if (t < start_ * (1 - round_off)) return false;
  if (every_ == 0) return has_released;
  return is_multiple(t, every_);
}

/// Its halves are to be slender.
template <int D>
bool Spacing<D>::may_be_split(double length, double volume) const {
  const double half = length / 2;
  return half * half * half >= slender_ * volume / 2;
}

/// Elements that ask to be split.
template <int D>
std::vector<Index> Spacing<D>::too_large(const Jet<D>& jet) const {
  const Elements e = elements(jet);
  std::vector<Index> found;
  for (Index i = 0; i + left_alone < jet.size(); ++i)
    if ((e.length[i] > longest_ || e.turn[i] > most_turn_) && may_be_split(e.length[i], e.volume[i]))
      found.push_back(i);
  return found;
}

/// One that is not the larger of two neighbours waits until the other has been split.
template <int D>
std::vector<Index> Spacing<D>::to_split(const Jet<D>& jet) const {
  std::vector<Index> wanted = too_large(jet), found;
  if (wanted.empty()) return found;
  const Elements e = elements(jet);
  for (std::size_t n = 0; n < wanted.size(); ++n) {  // which grows on the way
    const Index i = wanted[n];
    bool waits = false;
    for (const Index neighbour : {i - 1, i + 1}) {
      const double volume = neighbour < 0 ? beyond_oldest(jet) : e.volume[neighbour];
      if (volume <= e.volume[i] * (1 + round_off)) continue;
      waits = true;
      if (neighbour >= 0 && neighbour + left_alone < jet.size() &&
          may_be_split(e.length[neighbour], e.volume[neighbour]))
        wanted.push_back(neighbour);
    }
    if (!waits) found.push_back(i);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Beads at which two elements might be merged, but for their neighbours' merging.
template <int D>
std::vector<Index> Spacing<D>::that_might_merge(const Jet<D>& jet) const {
  const Elements e = elements(jet);
  std::vector<Index> found;
  for (Index k = 1; k + left_alone < jet.size(); ++k) {
    const Index i = k - 1;
    const double V = e.volume[i] + e.volume[k];
    const double below = i > 0 ? e.volume[i - 1] : beyond_oldest(jet), above = e.volume[k + 1];
    const bool alike = std::abs(e.volume[i] - e.volume[k]) <= round_off * V;
    const double smaller = below > 0 ? std::min(below, above) : above;
    const bool graded = V <= 2 * smaller * (1 + round_off);
    const bool fine =
        e.length[i] + e.length[k] < longest_ / 2 && std::max(e.turn[i], e.turn[k]) < most_turn_ / 4;
    if (alike && graded && fine && V <= 1 + round_off) found.push_back(k);
  }
  return found;
}

/// Of those next to each other every other one, from the oldest on.
template <int D>
std::vector<Index> Spacing<D>::to_merge(const Jet<D>& jet) const {
  std::vector<Index> found;
  for (const Index k : that_might_merge(jet))
    if (found.empty() || found.back() + 1 < k) found.push_back(k);
  return found;
}

namespace {

/// Whether volumes rise from element to element all the way from the end of a part, so that the elements of
/// `rows` may have to be split for one that is beyond it.
template <int D>
bool rise_from_outside(const Jet<D>& part, std::pair<Index, Index> rows) {
  const auto rises = [&](Index from, Index to) {
    return part.volume[to] > part.volume[from] * (1 + round_off);
  };
  bool older = !part.from_oldest, younger = !part.to_youngest;
  for (Index i = 0; i < rows.first; ++i) older = older && rises(i, i + 1);
  for (Index i = rows.second; i + left_alone <= part.size(); ++i) younger = younger && rises(i, i - 1);
  return older || younger;
}

}  // namespace

/// Which of the beads next to each other merge is told by where they begin.
template <int D>
bool Spacing<D>::merges_tell(const Jet<D>& part, Index first) const {
  if (part.from_oldest) return true;
  const std::vector<Index> might = that_might_merge(part);
  for (Index k = 2; k < first; ++k)
    if (!std::binary_search(might.begin(), might.end(), k)) return true;
  return false;
}

/// An element is judged by two beads on either side of it, a bead by as many, and as the nozzle's rule leaves
/// the youngest elements alone, so it seems to of those at the end of a part.
template <int D>
std::optional<std::vector<Index>> Spacing<D>::asking(Kind kind, const Jet<D>& part,
                                                     std::pair<Index, Index> rows) const {
  const bool seen =
      (part.from_oldest || rows.first >= 2) && (part.to_youngest || rows.second + left_alone <= part.size());
  if (!seen || (kind == Kind::split ? rise_from_outside(part, rows) : !merges_tell(part, rows.first)))
    return {};
  std::vector<Index> found = kind == Kind::split ? to_split(part) : to_merge(part);
  std::erase_if(found, [&](Index row) { return row < rows.first || row >= rows.second; });
  return found;
}

template <int D>
bool Spacing<D>::content(const Jet<D>& part) const {
  return too_large(part).empty() && to_merge(part).empty();
}

template <int D>
Refinement Spacing<D>::refinement(const std::function<std::vector<Index>(Kind)>& asking,
                                  const std::function<void(const RefinementPass&)>& refine) const {
  constexpr int most_passes = 30;  // each halves: more are not needed by any jet that is still finite
  Refinement all;
  for (const Kind kind : {Kind::split, Kind::merge})
    for (int pass = 0; pass < most_passes; ++pass) {
      RefinementPass next{kind, asking(kind), of_beads_};
      if (next.rows.empty()) break;
      refine(next);
      all.push_back(std::move(next));
    }
  return all;
}

template <int D>
Refinement Spacing<D>::refinement(const Jet<D>& jet) const {
  Jet<D> trial = jet;
  return refinement([&](Kind kind) { return kind == Kind::split ? to_split(trial) : to_merge(trial); },
                    [&](const RefinementPass& pass) { refine(trial, pass); });
}

template class Spacing<1>;
template class Spacing<3>;

}  // namespace treejet
