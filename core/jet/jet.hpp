#pragma once
/// The jet: a table of beads, everything scaled (core/jet/scales.hpp).
///
///     collector                                             nozzle
///        |     o-----------o--------o-----o----o - - (o) - - |>
///        |   bead 0      bead 1              bead n-1  held
///              element 0     element 1 ...      element n-1
///
/// Row 0 is the oldest bead, the one nearest to the collector; row n-1 is the youngest. Element i joins bead
/// i to its upper neighbour, bead i+1 or, for i = n-1, the nozzle, and owns the stress sigma_i. Insertion
/// appends a row, removal drops row 0. Beads may differ in mass, charge and volume; the volume is that of the
/// element, pi a_i^2 l_i, so that its radius follows from its length; what the youngest element is fed
/// (core/jet/feed_by_flow.hpp) comes on top. The nozzle and the bead held below it
/// are boundary conditions, functions of time and of bead n-1 (core/jet/nozzle.hpp), and therefore not rows.
/// Source: paper, Sec. "Equations of motion" and "Jet insertion".

#include <cstdint>
#include <vector>

#include "core/base/archive.hpp"
#include "core/base/vec.hpp"

namespace treejet {

/// A point of the solution: the state with its slope.
template <int D>
struct SolutionPoint {
  double t = 0;
  State<D> y, slope;

  void visit(Archive& state) { state(t, y, slope); }
};

using IdColumn = Eigen::Array<std::int64_t, Eigen::Dynamic, 1>;

/// The solution at this moment, and what is constant in its beads.
template <int D>
struct Jet : SolutionPoint<D> {
  Eigen::ArrayXd mass, charge;
  Eigen::ArrayXd volume;     ///< of the element that a bead owns, which stays as it stretches
  bool held = false;         ///< a bead waits below the nozzle (core/jet/feed.hpp)
  double last_release = 0;   ///< when, if the flow is given
  std::int64_t removed = 0;  ///< beads that have left at the collector: without refinement bead i was the
                             ///< (removed + i)-th inserted
  IdColumn id;               ///< of the beads, from 1 in the order of their births; none without refinement
  std::int64_t born = 0;     ///< beads that have been given an id
  bool from_oldest = true, to_youngest = true;  ///< false of a part of a jet: its end is not the jet's
  /// Of a part of a jet whose elements may be unequal: the volumes of all, and the row of its first.
  const Eigen::ArrayXd* all_volumes = nullptr;
  Eigen::Index first_of_all = 0;

  Eigen::Index size() const { return this->y.rows(); }

  void visit(Archive& state) {
    SolutionPoint<D>::visit(state);
    state(mass, charge, volume, held, last_release, removed, id, born);
  }
};

/// Which beads a jet has: one that goes on has the same numbers again only as long as no beads come, go or
/// are refined. Of a jet without ids (born is 0) they do not tell.
struct Census {
  Eigen::Index beads = 0;
  std::int64_t removed = 0, born = 0;
  bool operator==(const Census&) const = default;
};

/// A bead, scaled: an initial one has mass, charge and volume 1.
template <int D>
struct Bead {
  Bead(const Vec<D>& r = Vec<D>::Zero(), const Vec<D>& v = Vec<D>::Zero(), double sigma = 0, double m = 1,
       double q = 1)
      : position(r), velocity(v), stress(sigma), mass(m), charge(q) {}

  Vec<D> position, velocity;
  double stress, mass, charge, volume = 1;
  std::vector<double> added;  ///< of the columns that the scene has added, one each
};

/// Appends a bead above the youngest one.
template <int D>
void append(Jet<D>& jet, const Bead<D>& bead) {
  const Eigen::Index n = jet.size();
  jet.y.conservativeResize(n + 1, Eigen::NoChange);
  jet.y.row(n).template head<own_columns<D>>() << bead.position.transpose().array(),
      bead.velocity.transpose().array(), bead.stress;
  for (std::size_t k = 0; k < bead.added.size(); ++k)
    jet.y(n, own_columns<D> + static_cast<Eigen::Index>(k)) = bead.added[k];
  const auto add = [n](Eigen::ArrayXd& constants, double value) {
    constants.conservativeResize(n + 1);
    constants[n] = value;
  };
  add(jet.mass, bead.mass);
  add(jet.charge, bead.charge);
  add(jet.volume, bead.volume);
  if (jet.id.size() > 0) {
    jet.id.conservativeResize(n + 1);
    jet.id[n] = ++jet.born;
  }
}

/// Appends beads with what is constant in them, without slopes.
template <int D>
void append(Jet<D>& jet, const Jet<D>& more) {
  const auto join = [](auto& to, const auto& rows) {
    to.conservativeResize(to.rows() + rows.rows(), Eigen::NoChange);
    to.bottomRows(rows.rows()) = rows;
  };
  join(jet.y, more.y);
  for (auto each : {&Jet<D>::mass, &Jet<D>::charge, &Jet<D>::volume}) join(jet.*each, more.*each);
  join(jet.id, more.id);
}

/// Which bead row i is, from 0 in the order of their births, whatever becomes of its neighbours.
inline std::int64_t number(const IdColumn& id, std::int64_t removed, Eigen::Index i) {
  return id.size() > 0 ? id[i] - 1 : removed + i;
}

/// Every bead has its constants, and all have an id or none: so it is, unless a file says otherwise.
template <int D>
bool complete(const Jet<D>& jet) {
  const Eigen::Index n = jet.size();
  return jet.mass.size() == n && jet.charge.size() == n && jet.volume.size() == n &&
         (jet.id.size() == n || jet.id.size() == 0) && jet.removed >= 0;
}

/// The beads of a jet at another moment, without a slope.
template <int D>
Jet<D> at(const Jet<D>& jet, double t, const State<D>& y) {
  Jet<D> then;
  then.t = t;
  then.y = y;
  then.mass = jet.mass;
  then.charge = jet.charge;
  then.volume = jet.volume;
  then.held = jet.held;
  then.last_release = jet.last_release;
  then.removed = jet.removed;
  then.id = jet.id;
  then.born = jet.born;
  return then;
}

/// What a jet is beside its beads, of which it has none.
template <int D>
Jet<D> without_beads(const Jet<D>& jet) {
  Jet<D> none = at<D>(jet, jet.t, jet.y.topRows(0));
  for (auto* constants : {&none.mass, &none.charge, &none.volume}) constants->resize(0);
  none.id.resize(0);
  return none;
}

/// Length of the polygon from the oldest bead to `end`, the nozzle or what follows the youngest row.
template <int D>
double path_length(const State<D>& y, const Vec<D>& end) {
  double length = 0;
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    const Vec<D> upper = i + 1 < y.rows() ? position<D>(y, i + 1) : end;
    length += (position<D>(y, i) - upper).norm();
  }
  return length;
}

/// Drops the oldest bead.
template <int D>
void drop_first(Jet<D>& jet) {
  drop_first_row(jet.y);
  for (auto* constants : {&jet.mass, &jet.charge, &jet.volume}) drop_first_row(*constants);
  if (jet.id.size() > 0) drop_first_row(jet.id);
  ++jet.removed;
}

}  // namespace treejet
