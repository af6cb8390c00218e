#pragma once
/// How long the next step is.
///
/// Fixed: steps end on the grid k dt. An event inside a step splits it; the next step leads back to the grid.
///
/// By tolerance: a step stands if its local error, core/jet/error_norm.hpp over the tolerance, is at most the
/// scheme's share (core/jet/schemes.hpp); with the error over that share the next one is
/// h * 0.9 * error^-alpha * previous_error^beta (proportional-integral control). After an
/// event beads are pushed in another way than before, and events repeat: the step there is what the last
/// first step after an event of this kind would have been allowed; after the first of its kind it is half the
/// last step. Source of the controller: Hairer, Norsett, Wanner, "Solving ODEs I", II.4; Gustafsson (1991).

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/multiples.hpp"
#include "core/jet/jet.hpp"
#include "core/jet/observer.hpp"

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
    // a remainder that round-off may have left joins the next step
    return std::min(dt_ * (last_multiple(t, dt_) + 1), end) - t;
  }
  bool accepts(double, double, double) override { return true; }
  bool steps_to_events() const override { return false; }

 private:
  double dt_;
};

class AdaptiveStep final : public StepControl {
 public:
  /// No step is longer than `longest`, whatever its error.
  AdaptiveStep(double first, int order, double longest = std::numeric_limits<double>::infinity(),
               double share = 1)
      : h_(first), order_(order), longest_(longest), share_(share) {}

  double proposal(double t, double end) const override { return std::min({h_, longest_, end - t}); }

  bool accepts(double, double h, double error) override {
    const double k = order_;  // the estimate is of order k in h
    error /= share_;
    if (!(error <= 1)) {
      h_ = h * (std::isfinite(error) ? std::max(0.2, 0.9 * std::pow(error, -1 / k)) : 0.1);
      rejected_ = true;
      return false;
    }
    const double e = std::max(error, 1e-10);
    double factor =
        after_ ? 0.9 * std::pow(e, -1 / k) : 0.9 * std::pow(e, -0.7 / k) * std::pow(previous_error_, 0.4 / k);
    // more at once, and the last steps before an event would be longer than the first ones after it
    factor = std::clamp(factor, 0.2, rejected_ ? 1.0 : 1.8);
    // a step cut short for an event says little of what the next may be
    if (h >= 0.5 * h_ || factor * h > h_) {
      h_ = h * factor;
      previous_error_ = std::max(e, 1e-4);
      // little longer than the last time: what is rejected now is not tried again at once
      if (after_) {
        double& first = first_step(*after_);
        first = first > 0 ? std::min(h_, 1.1 * first) : h_;
      }
    }
    rejected_ = false;
    after_.reset();
    return true;
  }

  bool steps_to_events() const override { return true; }

  void event(EventKind kind) override {
    after_ = kind;
    const double first = first_step(kind);
    h_ = first > 0 ? first : h_ / 2;
  }

  void visit(Archive& state) override { state(h_, previous_error_, rejected_, after_, first_); }

 private:
  double& first_step(EventKind kind) { return first_[static_cast<std::size_t>(kind)]; }

  double h_;
  int order_;
  double longest_, share_;
  double previous_error_ = 1e-4;
  bool rejected_ = false;
  std::optional<EventKind> after_;    ///< an event, unless a step has been made since
  std::array<double, 4> first_ = {};  ///< allowed after each kind of event; 0: none yet
};

}  // namespace treejet
