#pragma once
/// The nozzle: a point charge at x = 0 that may circle in the y-z plane, and the rule by which it lets beads
/// go.
///
/// Insertion takes two events, both functions of d, the distance of the youngest bead (row n-1) from the
/// nozzle:
///
///     place    at d = 1.5 l_step: a bead is held on the chord nozzle -> bead n-1 at distance l_step; it
///              exists as a charge only, faded in by s(d) = (1 - cos(2 pi (d / l_step - 1.5))) / 2;
///
///     release  at d = 2 l_step, where s = 1: the held bead becomes row n with stress 0 and half the velocity
///              of its predecessor above the nozzle velocity (the paper's dragging velocity), so that the
///              strain rate of the element below is continuous.
///
/// The circle is y = A cos(K_s t), z = A sin(K_s t), evaluated, not integrated; its velocity is the
/// derivative. All quantities scaled. Source: paper, Sec. "Perturbations at the nozzle" and "Jet insertion";
/// the first event is JETSPIN's, the paper tells of the second only.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/jet/columns.hpp"
#include "core/jet/jet.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

template <int D>
class Nozzle {
 public:
  static constexpr double charge = 1;

  /// The beads it lets go have the values at birth of the columns that the scene adds.
  explicit Nozzle(const Parameters& p, const Columns& added = {})
      : inserting_(p.inserting),
        l_step_(groups(p).L_step),
        speed_(p.nozzle_velocity / scales(p).velocity),
        release_waits_(event_rule(p) == EventRule::step) {
    for (const Column& column : added) at_birth_.push_back(column.at_birth);
    if (p.perturb && D == 3) {
      angular_frequency_ = groups(p).K_s;
      amplitude_ = p.perturb_amplitude / scales(p).length;
    }
  }

  bool inserting() const { return inserting_; }
  double l_step() const { return l_step_; }

  Vec<D> position(double t) const { return on_circle(0, amplitude_, angular_frequency_ * t); }
  Vec<D> velocity(double t) const {
    return on_circle(speed_, angular_frequency_ * amplitude_, angular_frequency_ * t + std::numbers::pi / 2);
  }

  /// Distance of the youngest bead, at r, beyond the one at which the next insertion event is due.
  double overdue(const Jet<D>& jet, const Vec<D>& r, double t) const {
    return (r - position(t)).norm() - (jet.held ? 2.0 : 1.5) * l_step_;
  }

  struct Held {
    Vec<D> position;
    double charge;
  };

  /// The held bead while the youngest one is at r and the nozzle at `origin`.
  Held held(const Vec<D>& r, const Vec<D>& origin) const {
    const Vec<D> way = r - origin;
    const double length = way.norm();
    return {origin + l_step_ / length * way, faded_charge(length / l_step_)};
  }

  /// s(d), d in units of l_step. Past d = 2, where only the step that goes beyond a located release asks for
  /// it, it goes on smoothly: a kink inside that step would make the release an event of third order. Where
  /// the release waits for the end of a step, the charge waits at 1.
  double faded_charge(double d) const {
    if (d <= 1.5) return 0;
    if (d >= 2.0 && release_waits_) return 1;
    return 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (d - 1.5));
  }

  void place(Jet<D>& jet) const { jet.held = true; }

  void release(Jet<D>& jet) const {
    const Eigen::Index youngest = jet.size() - 1;
    const Vec<D> r = treejet::position<D>(jet.y, youngest);
    Vec<D> v = treejet::velocity<D>(jet.y, youngest) / 2;
    v[0] += speed_ / 2;
    Bead<D> bead(held(r, position(jet.t)).position, v);
    bead.added = at_birth_;
    append<D>(jet, bead);
    jet.held = false;
  }

  /// NumericalError if either event has been missed by more than half an element.
  void check_timely(const Jet<D>& jet) const {
    const Eigen::Index youngest = jet.size() - 1;
    const double late = overdue(jet, treejet::position<D>(jet.y, youngest), jet.t) / l_step_;
    if (late <= 0.5) return;
    throw NumericalError(fmt::format(
        "at scaled time {}: bead {} is {:.3g} elements beyond the place where the nozzle should have "
        "released another; likely cause: the time step is too large for events seen at step ends",
        jet.t, youngest, late));
  }

 private:
  Vec<D> on_circle(double x, double radius, double phase) const {
    Vec<D> r = Vec<D>::Zero();
    r[0] = x;
    if constexpr (D == 3) {
      r[1] = radius * std::cos(phase);
      r[2] = radius * std::sin(phase);
    }
    return r;
  }

  bool inserting_;
  double l_step_, speed_;
  bool release_waits_;  ///< for the end of a step
  double angular_frequency_ = 0, amplitude_ = 0;
  std::vector<double> at_birth_;  ///< of the added columns
};

}  // namespace treejet
