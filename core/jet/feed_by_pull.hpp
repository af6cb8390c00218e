#pragma once
/// Feed by pull, the paper's rule: the jet draws from the nozzle what it pulls.
///
/// Insertion takes two events, both functions of d, the distance of the youngest bead (row n-1) from the
/// nozzle:
///
///     place    at d = 1.5 l_step: a bead is held on the chord nozzle -> bead n-1 at distance l_step; it
///              exists as a charge only, faded in by s(d) = (1 - cos(2 pi (d / l_step - 1.5))) / 2;
///
///     release  at d = 2 l_step, where s = 1: the held bead becomes row n with stress 0 and half the velocity
///              of its predecessor above the nozzle velocity (the paper's dragging velocity), so that the
///              strain rate of the element below is continuous. Without dragging velocity (JETSPIN's from
///              1.21 on) it has that of the fluid at the nozzle, and the strain rate doubles.
///
/// Source: paper, Sec. "Jet insertion"; the first event is JETSPIN's, the paper tells of the second only.

#include <cmath>
#include <numbers>

#include "core/jet/feed.hpp"

namespace treejet {

template <int D>
class FeedByPull final : public FeedRule<D> {
 public:
  /// `speed`: of the fluid at the nozzle, along x. `release_waits`: for the end of a step. `drags`: whether a
  /// bead is released with the dragging velocity.
  FeedByPull(double l_step, double speed, bool release_waits, bool drags = true)
      : l_step_(l_step), speed_(speed), release_waits_(release_waits), drags_(drags) {}

  double overdue(const Jet<D>& jet, const Vec<D>& r, const Vec<D>& nozzle, double) const override {
    return (r - nozzle).norm() - (jet.held ? 2.0 : 1.5) * l_step_;
  }

  HeldBead<D> held(const Jet<D>&, const Vec<D>& r, const Vec<D>& nozzle, double) const override {
    const Vec<D> way = r - nozzle;
    const double length = way.norm();
    return {nozzle + l_step_ / length * way, faded_charge(length / l_step_)};
  }

  /// s(d), d in units of l_step. Past d = 2, where only the step that goes beyond a located release asks for
  /// it, it goes on smoothly: a kink inside that step would make the release an event of third order. Where
  /// the release waits for the end of a step, the charge waits at 1.
  double faded_charge(double d) const {
    if (d <= 1.5) return 0;
    if (d >= 2.0 && release_waits_) return 1;
    return 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (d - 1.5));
  }

  double drawn(const Jet<D>&, const Vec<D>& r, const Vec<D>& nozzle, double) const override {
    return (r - nozzle).norm() / l_step_;
  }

  Bead<D> release(Jet<D>& jet, const Inlet<D>& inlet, const std::vector<double>& at_birth) const override {
    const Eigen::Index youngest = jet.size() - 1;
    const Vec<D> r = position<D>(jet.y, youngest);
    Vec<D> v = drags_ ? Vec<D>(velocity<D>(jet.y, youngest) / 2) : Vec<D>(Vec<D>::Zero());
    v[0] += drags_ ? speed_ / 2 : speed_;
    Bead<D> bead(held(jet, r, inlet.position, jet.t).position, v);
    bead.added = at_birth;
    return bead;
  }

 private:
  double l_step_, speed_;
  bool release_waits_, drags_;
};

}  // namespace treejet
