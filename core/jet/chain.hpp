#pragma once
/// The chain at one instant, as the force terms see it: the beads of a stage with the nozzle and the held
/// bead in place, and the geometry of the elements.
///
/// Points are the n beads, then the held bead if there is one, then the nozzle. Element i (i < n) joins bead
/// i to its upper neighbour; that of bead n-1 is the nozzle even while a bead is held:
///     l_i = |r_i - r_up|,   t_i = (r_i - r_up) / l_i   (away from the nozzle),   strain rate = (v_i -
///     v_up).t_i / l_i.
/// Volume is conserved, pi a_i^2 l_i = pi a_0^2 l_step V_i with V_i = 1 for an initial bead; the youngest
/// element has the held bead's, too.
///
/// Velocities, stress and added columns are those of the state that the chain was set from, which outlives
/// its use. Scaled. Source: paper, Sec. "Equations of motion".

#include <utility>

#include "core/jet/jet.hpp"
#include "core/jet/nozzle.hpp"

namespace treejet {

template <int D>
struct Chain {
  using Points = Eigen::Array<double, Eigen::Dynamic, D>;

  double t = 0;
  int beads = 0;
  std::int64_t removed = 0;                     ///< beads that have left the jet
  const IdColumn* id = nullptr;                 ///< of the beads, none without refinement
  bool from_oldest = true, to_youngest = true;  ///< false of a part of a jet: its end is not the jet's
  Points point;                                 ///< beads, [held], nozzle
  Eigen::ArrayXd point_charge;                  ///< as the Coulomb sum sees it
  Points tangent;                               ///< per element, like all below
  Eigen::ArrayXd inverse_length, strain_rate, stress, inverse_mass, volume;
  const State<D>* state = nullptr;  ///< of the beads
  /// Of all elements of the jet, as they left the nozzle, also where the chain is but a part of it, or its
  /// two ends (core/jet/right_hand_side.hpp), `oldest` rows being the old one; it outlives an evaluation.
  /// Rows from `oldest` on are `left_out` higher in the jet.
  const Eigen::ArrayXd* volume_at_nozzle = nullptr;
  Eigen::Index oldest = 0, left_out = 0;
  Census census;         ///< of the whole jet
  double held_mass = 0;  ///< of the held bead, and its volume
  Vec<D> nozzle_velocity = Vec<D>::Zero();

  int points() const { return static_cast<int>(point.rows()); }
  bool holds_bead() const { return points() == beads + 2; }

  /// The row of the jet that row i of the chain is.
  Eigen::Index row_of_jet(Eigen::Index i) const { return i < oldest ? i : i + left_out; }
  /// Which bead row i is (core/jet/jet.hpp).
  std::int64_t number(Eigen::Index i) const { return treejet::number(*id, removed, i); }

  /// Velocity of bead i, and of its upper neighbour.
  Vec<D> velocity(int i) const { return treejet::velocity<D>(*state, i); }
  Vec<D> velocity_above(int i) const { return i + 1 < beads ? velocity(i + 1) : nozzle_velocity; }
  /// An added column, by its place among them.
  auto column(int added) const { return state->col(own_columns<D> + added); }
};

/// Sizes the chain for the jet and sets its boundary: held bead and nozzle.
template <int D>
void set_boundary(Chain<D>& chain, const Jet<D>& jet, const Nozzle<D>& nozzle, double t, const State<D>& y) {
  const Eigen::Index n = y.rows(), points = n + (jet.held ? 2 : 1);
  chain.t = t;
  chain.removed = jet.removed;
  chain.id = &jet.id;
  chain.from_oldest = jet.from_oldest;
  chain.to_youngest = jet.to_youngest;
  chain.beads = static_cast<int>(n);
  chain.state = &y;
  chain.volume_at_nozzle = jet.all_volumes ? jet.all_volumes : &jet.volume;
  chain.oldest = 0;
  chain.left_out = jet.first_of_all;
  chain.census = {chain.volume_at_nozzle->size(), jet.removed - jet.first_of_all, jet.born};
  chain.nozzle_velocity = nozzle.velocity(t);
  chain.point.resize(points, Eigen::NoChange);
  chain.point_charge.resize(points);
  chain.tangent.resize(n, Eigen::NoChange);
  for (auto* a :
       {&chain.inverse_length, &chain.strain_rate, &chain.stress, &chain.inverse_mass, &chain.volume})
    a->resize(n);
  chain.held_mass = 0;
  if (jet.held) {
    const auto held = nozzle.held(jet, position<D>(y, n - 1), t);
    chain.point.row(n) = held.position.transpose();
    chain.point_charge[n] = held.charge;
    chain.held_mass = held.mass;
  }
  chain.point.row(points - 1) = nozzle.position(t).transpose();
  chain.point_charge[points - 1] = Nozzle<D>::charge;
}

/// Sets the beads first <= i < last as points, with their masses.
template <int D>
void set_points(Chain<D>& chain, const Jet<D>& jet, const State<D>& y,
                std::pair<Eigen::Index, Eigen::Index> rows) {
  const auto [first, last] = rows;
  chain.point.middleRows(first, last - first) = y.middleRows(first, last - first).template leftCols<D>();
  chain.point_charge.segment(first, last - first) = jet.charge.segment(first, last - first);
  chain.inverse_mass.segment(first, last - first) = jet.mass.segment(first, last - first).inverse();
}

/// Sets the elements first <= i < last, after the boundary.
template <int D>
void set_elements(Chain<D>& chain, const Jet<D>& jet, const State<D>& y,
                  std::pair<Eigen::Index, Eigen::Index> rows);

}  // namespace treejet
