#pragma once
/// What is summed up between two rows of output: the window behind the averaged observables of Appendix B.
///
/// Counts and sums follow the events exactly. The path length is integrated over the dense output of each
/// step by Gauss's rule with two points, whose error, O(h^5) a step, is far below that of the step. All
/// scaled.

#include <limits>
#include <numbers>

#include "core/jet/collector.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/dense_output.hpp"
#include "core/jet/material.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/observer.hpp"

namespace treejet {

struct Window {
  double begin = 0;
  double charge_in = 0, mass_in = 0;    ///< of the beads placed at the nozzle
  double charge_out = 0, mass_out = 0;  ///< of the beads removed at the collector
  int arrivals = 0;
  double weight = 0;  ///< of the arrivals, their mass as they left the nozzle; sums by it:
  double speed = 0, strain_rate = 0, radius = 0;      ///< radius in units of a_0
  double evaporated = 0, viscosity = 0, modulus = 0;  ///< mass, mu / mu_0, G / G_0
  double release_speed = 0, path_length = 0;          ///< integrals over time
};

template <int D>
class Statistics {
 public:
  Statistics(const Nozzle<D>& nozzle, const Collector& collector, const Material& material = {})
      : nozzle_(nozzle), collector_(collector), material_(material) {}

  /// Integrates the path length too, which costs a pass over the beads each step.
  void follow_path() { follows_path_ = true; }
  bool follows_path() const { return follows_path_; }

  const Window& window() const { return window_; }

  /// Of a jet that has flown elsewhere it is not known how fast the nozzle has let the last bead go, nor where
  /// the oldest was when the last one arrived: about as far from the collector as the next is behind it now.
  void start(const Jet<D>& jet) {
    begin_window(jet.t);
    if (jet.t > 0) last_release_speed_ = std::numeric_limits<double>::quiet_NaN();
    if (jet.size() > 1) next_arrival_from_ = collector_.distance() - (jet.y(0, 0) - jet.y(1, 0));
  }

  void begin_window(double t) {
    window_ = Window{};
    window_.begin = integrated_to_ = t;
  }

  /// Integrates over the segment from where the last call ended to t.
  void integrate(const DenseOutput<D>& segment, double t, const Decomposition<D>& all = undivided<D>) {
    const double from = integrated_to_, dt = t - from;
    integrated_to_ = t;
    if (!(dt > 0)) return;
    window_.release_speed += dt * last_release_speed_;
    if (!follows_path_) return;
    const double middle = from + dt / 2, off_middle = dt / 2 / std::numbers::sqrt3;
    for (const double at : {middle - off_middle, middle + off_middle}) {
      segment.positions_at(at, then_);
      window_.path_length += dt / 2 * all.path_length(then_, nozzle_.position(at));
    }
  }

  void event(EventKind kind, const Jet<D>& jet) {
    if (kind == EventKind::place) {
      window_.charge_in += 1;
      window_.mass_in += 1;
    } else if (kind == EventKind::release) {
      last_release_speed_ = velocity<D>(jet.y, jet.size() - 1).norm();
      ++released_;
    } else {
      arrival(jet);
    }
  }

  void refined(const Refinement& refinement) {
    for (const RefinementPass& pass : refinement)
      (pass.kind == RefinementPass::Kind::split ? splits_ : merges_) += std::ssize(pass.rows);
  }

  /// Elements split and merged since the start.
  std::int64_t splits() const { return splits_; }
  std::int64_t merges() const { return merges_; }

  /// Charge that has left the nozzle, the part of the next bead that has been drawn out counted.
  double charge_fed(const Jet<D>& jet) const {
    if (!nozzle_.inserting()) return 0;
    if (jet.size() == 0) return double(released_);
    return double(released_) + nozzle_.drawn(jet) - 1;
  }

  /// Charge that has reached the collector, the part of the next bead on its way since the last arrival
  /// counted.
  double charge_landed(const Jet<D>& jet) const {
    if (jet.removed == 0 || jet.size() == 0) return charge_landed_;
    // seen at step ends, the next one may have been there already as the last one was removed
    const double left = collector_.distance() - next_arrival_from_;
    const double way = left > 0 ? (jet.y(0, 0) - next_arrival_from_) / left : 1;
    return charge_landed_ + way * jet.charge[0];
  }

  void visit(Archive& state) {
    state(window_, integrated_to_, last_release_speed_, released_, charge_landed_, next_arrival_from_,
          splits_, merges_);
  }

 private:
  void arrival(const Jet<D>& jet) {
    const bool alone = jet.size() == 1;
    const Vec<D> upper = alone ? nozzle_.position(jet.t) : position<D>(jet.y, 1);
    const double l = (position<D>(jet.y, 0) - upper).norm();
    ++window_.arrivals;
    window_.charge_out += jet.charge[0];
    const double left = material_.template remaining<D>(jet.y, 0);
    window_.mass_out += jet.mass[0] * left;
    window_.weight += jet.mass[0];
    window_.evaporated += jet.mass[0] * (1 - left);
    window_.viscosity += jet.mass[0] * material_.template viscosity_ratio<D>(jet.y, 0);
    window_.modulus += jet.mass[0] * material_.template modulus_ratio<D>(jet.y, 0);
    window_.speed += jet.mass[0] * velocity<D>(jet.y, 0).norm();
    window_.strain_rate += jet.mass[0] * strain_rate<D>(jet, nozzle_, 0);
    const double volume = alone ? nozzle_.volume_of_youngest(jet) : jet.volume[0];
    window_.radius += jet.mass[0] * std::sqrt(volume * left * nozzle_.l_step() / l);
    charge_landed_ += jet.charge[0];
    next_arrival_from_ = upper[0];
  }

  const Nozzle<D>& nozzle_;
  const Collector& collector_;
  Material material_;
  bool follows_path_ = false;
  Window window_;
  double integrated_to_ = 0, last_release_speed_ = 0;
  std::int64_t released_ = 0;
  double charge_landed_ = 0, next_arrival_from_ = 0;
  std::int64_t splits_ = 0, merges_ = 0;
  State<D> then_;  ///< positions within a step
};

}  // namespace treejet
