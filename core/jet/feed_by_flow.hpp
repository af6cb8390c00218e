#pragma once
/// Feed by flow: a pump gives the nozzle a volume a time, of the charge and mass of the fluid; the jet has to
/// take it.
///
/// The element of the youngest bead (row n-1) is a control volume that grows: since the last release its
/// volume is
///
///     V(t) = 1 + (t - t_release) flow ,      flow = v_0 / l_step ,      v_0 = flow rate / (pi a_0^2) .
///
/// A bead is always held in the middle of the chord nozzle -> bead n-1, at the mean velocity of both. Mass
/// and charge V - 1 are its own: all that has been fed since the last release; those of the other beads stay.
/// As a bead that is bound to the chord it hands half of the forces on it to bead n-1, half to the nozzle,
/// and resists bead n-1 with a quarter of its mass (forces/terms/fed_element.hpp).
///
///     release  at V = 2: the held bead becomes row n, where it is, as fast as it is. Both halves keep
///              radius, strain rate and stress. Nothing else changes but the names: mass, charge, momentum
///              and the field are continuous; V is 1 again and an empty bead is held (place, at the same
///              instant).
///
/// The nozzle carries half a bead's mass, and the charge of a whole one: half ends the element, half stands
/// for the fluid behind it. Were the tube to end there, short waves along case 3 would grow at l_step = 4
/// a_0. Seen at step ends, V is beyond 2: the bead is released where it divides the volume into 1 and V - 1,
/// which keeps all sums, too. Nothing depends on where the jet is, so that a jet too weak to take the flow
/// grows thick at the nozzle.

#include "core/jet/feed.hpp"

namespace treejet {

template <int D>
class FeedByFlow final : public FeedRule<D> {
 public:
  FeedByFlow(double l_step, double speed) : l_step_(l_step), flow_(speed / l_step) {}

  double flow() const override { return flow_; }

  double overdue(const Jet<D>& jet, const Vec<D>&, const Vec<D>&, double t) const override {
    return (growth(jet, t) - (jet.held ? 1 : 0)) * l_step_;
  }

  HeldBead<D> held(const Jet<D>& jet, const Vec<D>& r, const Vec<D>& nozzle, double t) const override {
    return {(r + nozzle) / 2, growth(jet, t), growth(jet, t)};
  }

  double drawn(const Jet<D>& jet, const Vec<D>&, const Vec<D>&, double t) const override {
    return 1 + growth(jet, t);
  }

  Bead<D> release(Jet<D>& jet, const Inlet<D>& inlet, const std::vector<double>&) const override {
    const Eigen::Index youngest = jet.size() - 1, added = jet.y.added();
    const double V = 1 + growth(jet, jet.t), share = (V - 1) / V;
    const auto between = [&](const Vec<D>& nozzle, const Vec<D>& bead) -> Vec<D> {
      return nozzle + share * (bead - nozzle);
    };
    Bead<D> bead(between(inlet.position, position<D>(jet.y, youngest)),
                 between(inlet.velocity, velocity<D>(jet.y, youngest)), jet.y(youngest, stress_column<D>));
    const auto columns = jet.y.row(youngest).tail(added);
    bead.added.assign(columns.begin(), columns.end());
    jet.last_release += 1 / flow_;
    return bead;
  }

 private:
  /// V - 1.
  double growth(const Jet<D>& jet, double t) const { return (t - jet.last_release) * flow_; }

  double l_step_, flow_;
};

}  // namespace treejet
