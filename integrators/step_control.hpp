#pragma once
/// How long the next step is.
///
/// Fixed: steps end on the grid k dt. An event inside a step splits it; the next step leads back to the grid.
///
/// By tolerance: a step stands if its local error, core/error_norm.hpp over the tolerance, is at most 1; the
/// next one is h * 0.9 * error^-alpha * previous_error^beta (proportional-integral control).
/// Source of the controller: Hairer, Norsett, Wanner, "Solving ODEs I", II.4; Gustafsson (1991).

#include <algorithm>
#include <cmath>

#include "core/jet.hpp"
#include "core/watcher.hpp"

namespace treejet {

class StepControl {
 public:
  virtual ~StepControl() = default;
  /// The step to take from t, not beyond `end`.
  virtual double proposal(double t, double end) const = 0;
  /// Whether a step of size h with this error (0 without an estimate) stands; adapts the next proposal.
  virtual bool accepts(double t, double h, double error) = 0;
  /// Whether an event well inside a step is met by a new step that ends there, rather than by dense output.
  virtual bool steps_to_events() const = 0;
  virtual void event(EventKind) {}
  /// What a control remembers from one step to the next.
  virtual void visit(Archive&) {}
};

class FixedStep final : public StepControl {
 public:
  explicit FixedStep(double dt) : dt_(dt) {}

  double proposal(double t, double end) const override {
    constexpr double round_off = 1e-9;  // of a step: a remainder shorter than this joins the next step
    return std::min(dt_ * (std::floor(t / dt_ + round_off) + 1), end) - t;
  }
  bool accepts(double, double, double) override { return true; }
  bool steps_to_events() const override { return false; }

 private:
  double dt_;
};

class AdaptiveStep final : public StepControl {
 public:
  AdaptiveStep(double first, int order) : h_(first), order_(order) {}

  double proposal(double t, double end) const override { return std::min(h_, end - t); }

  bool accepts(double, double h, double error) override {
    const double k = order_;  // the estimate is of order k in h
    if (!(error <= 1)) {
      h_ = h * (std::isfinite(error) ? std::max(0.2, 0.9 * std::pow(error, -1 / k)) : 0.1);
      rejected_ = true;
      return false;
    }
    const double e = std::max(error, 1e-10);
    double factor = 0.9 * std::pow(e, -0.7 / k) * std::pow(previous_error_, 0.4 / k);
    factor = std::clamp(factor, 0.2, rejected_ ? 1.0 : 5.0);
    // a step cut short for an event says little of what the next may be
    if (h >= 0.5 * h_ || factor * h > h_) {
      h_ = h * factor;
      previous_error_ = std::max(e, 1e-4);
    }
    rejected_ = false;
    return true;
  }

  bool steps_to_events() const override { return true; }

  void event(EventKind kind) override {
    if (kind == EventKind::place) h_ *= 0.5;  // the held bead's charge starts to rise
  }

  void visit(Archive& state) override { state(h_, previous_error_, rejected_); }

 private:
  double h_;
  int order_;
  double previous_error_ = 1e-4;
  bool rejected_ = false;
};

}  // namespace treejet
