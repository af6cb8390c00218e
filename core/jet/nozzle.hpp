#pragma once
/// The nozzle: a point charge at x = 0 that may circle in the y-z plane, and the rule by which its fluid
/// becomes beads (core/jet/feed.hpp).
///
/// The circle is y = A cos(K_s t), z = A sin(K_s t), evaluated, not integrated; its velocity is the
/// derivative, that of the fluid along x added. All quantities scaled. Source: paper, Sec. "Perturbations at
/// the nozzle".

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/error.hpp"
#include "core/jet/columns.hpp"
#include "core/jet/feed_by_flow.hpp"
#include "core/jet/feed_by_pull.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

template <int D>
class Nozzle {
 public:
  static constexpr double charge = 1;

  /// `added`: the columns that the scene adds, whose values at birth its fluid has.
  explicit Nozzle(const Parameters& p, const Columns& added = {})
      : inserting_(p.inserting),
        l_step_(groups(p).L_step),
        speed_(inlet_velocity(p) / scales(p).velocity),
        feed_(rule(p)) {
    for (const Column& column : added) at_birth_.push_back(column.at_birth);
    if (p.perturb && D == 3) {
      angular_frequency_ = groups(p).K_s;
      amplitude_ = p.perturb_amplitude / scales(p).length;
    }
  }

  bool inserting() const { return inserting_; }
  double l_step() const { return l_step_; }
  const FeedRule<D>& feed() const { return *feed_; }
  /// Of the added columns, in fresh fluid.
  const std::vector<double>& at_birth() const { return at_birth_; }

  Vec<D> position(double t) const { return on_circle(0, amplitude_, angular_frequency_ * t); }
  Vec<D> velocity(double t) const {
    return on_circle(speed_, angular_frequency_ * amplitude_, angular_frequency_ * t + std::numbers::pi / 2);
  }
  Vec<D> acceleration(double t) const { return -angular_frequency_ * angular_frequency_ * position(t); }

  /// Length by which the next insertion event is overdue with the youngest bead at r.
  double overdue(const Jet<D>& jet, const Vec<D>& r, double t) const {
    return feed_->overdue(jet, r, position(t), t);
  }

  /// The held bead while the youngest one is at r.
  HeldBead<D> held(const Jet<D>& jet, const Vec<D>& r, double t) const {
    return feed_->held(jet, r, position(t), t);
  }

  /// Volume drawn out behind the youngest bead.
  double drawn(const Jet<D>& jet) const { return feed_->drawn(jet, youngest(jet), position(jet.t), jet.t); }

  /// Volume of the youngest element now.
  double volume_of_youngest(const Jet<D>& jet) const {
    const double own = jet.volume[jet.size() - 1];
    return jet.held ? own + held(jet, youngest(jet), jet.t).mass : own;
  }

  void place(Jet<D>& jet) const { jet.held = true; }

  void release(Jet<D>& jet) const {
    append<D>(jet, feed_->release(jet, {position(jet.t), velocity(jet.t)}, at_birth_));
    jet.held = false;
  }

  /// NumericalError if either event has been missed by more than half an element.
  void check_timely(const Jet<D>& jet) const {
    const double late = overdue(jet, youngest(jet), jet.t) / l_step_;
    if (late <= 0.5) return;
    throw NumericalError(fmt::format(
        "at scaled time {}: bead {} is {:.3g} elements beyond the place where the nozzle should have "
        "released another; likely cause: the time step is too large for events seen at step ends",
        jet.t, jet.size() - 1, late));
  }

 private:
  std::shared_ptr<const FeedRule<D>> rule(const Parameters& p) const {
    if (p.feed == Feed::flow) return std::make_shared<FeedByFlow<D>>(l_step_, speed_);
    return std::make_shared<FeedByPull<D>>(l_step_, speed_, event_rule(p) == EventRule::step, p.dragvel);
  }

  static Vec<D> youngest(const Jet<D>& jet) { return treejet::position<D>(jet.y, jet.size() - 1); }

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
  std::shared_ptr<const FeedRule<D>> feed_;
  double angular_frequency_ = 0, amplitude_ = 0;
  std::vector<double> at_birth_;
};

}  // namespace treejet
