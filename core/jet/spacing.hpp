#pragma once
/// Where a jet has its beads: which elements are to be split, and which merged.
///
/// At a bead between elements of lengths l_1, l_2 the chain has the curvature 2 |t_1 - t_2| / (l_1 + l_2); an
/// element turns by c, its length times the larger curvature at its beads. It is split where
///     l > longest               `dynamic refinement threshold`, or
///     c > sqrt(24 tolerance)    `dynamic refinement tolerance`: the chord of an arc that turns by c is
///                               shorter than the arc by c^2 / 24,
/// a larger neighbour first, so that volumes differ by a factor 2 at the most from element to element, and
/// only if its halves are no shorter than twice their radius. Two elements at a bead are merged where
///     both have the same volume, together no more than an element has that leaves the nozzle, their
///     outer neighbours at least half of it, l_1 + l_2 < longest / 2 and c < sqrt(24 tolerance) / 4 :
/// what is split is not at once merged, nor the other way about. The youngest elements are left alone: the
/// nozzle's rule is about them. Two or three passes settle it; each follows from the jet that the last has
/// left.
///
/// When: at multiples of `every`, where the march ends a step, or, without it, whenever the nozzle has
/// released a bead. Both times are functions of the solution, not of the steps, so a split costs no order in
/// time. Scaled.

#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/jet/columns.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/refinement.hpp"

namespace treejet {

template <int D>
class Spacing {
 public:
  /// `added`: the columns that the scene adds to the state.
  explicit Spacing(const Parameters& p, const Columns& added = {});

  using Kind = RefinementPass::Kind;

  /// What gives the jet the beads it needs; empty if it has them.
  Refinement refinement(const Jet<D>& jet) const;
  /// The same of a jet that others hold: `asking` tells which elements of it a split is due to, or which
  /// beads a merge, `refine` makes a pass.
  Refinement refinement(const std::function<std::vector<Eigen::Index>(Kind)>& asking,
                        const std::function<void(const RefinementPass&)>& refine) const;

  /// Of a part of a jet with some beads more on either side, those of rows first <= i < second to which a
  /// pass is due; nothing where that turns on what is beyond the part.
  std::optional<std::vector<Eigen::Index>> asking(Kind kind, const Jet<D>& part,
                                                  std::pair<Eigen::Index, Eigen::Index> rows) const;
  /// Whether a part of a jet, with three beads more on either side that others ask about, asks for nothing.
  bool content(const Jet<D>& part) const;

  /// The next time after t at which to look, infinite if releases tell.
  double next(double t) const;
  /// Whether to look now.
  bool due(double t, bool has_released) const;

 private:
  bool may_be_split(double length, double volume) const;
  std::vector<Eigen::Index> too_large(const Jet<D>& jet) const;
  std::vector<Eigen::Index> to_split(const Jet<D>& jet) const;
  std::vector<Eigen::Index> that_might_merge(const Jet<D>& jet) const;
  std::vector<Eigen::Index> to_merge(const Jet<D>& jet) const;
  bool merges_tell(const Jet<D>& part, Eigen::Index first) const;

  static constexpr double never = std::numeric_limits<double>::infinity();
  double longest_ = never;    ///< element
  double most_turn_ = never;  ///< of an element
  double every_ = 0;          ///< 0: at releases
  double start_ = 0;
  double slender_ = 0;                  ///< l^3 / V of an element as long as twice its radius
  std::vector<Eigen::Index> of_beads_;  ///< columns
};

}  // namespace treejet
