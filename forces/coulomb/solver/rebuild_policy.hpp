#pragma once
/// When a tree that promises an accuracy is to be sorted, measured and chosen anew, as its points move and
/// their number changes. All from counts: the same calls come to the same ends on any rank, at any speed.

#include <cmath>
#include <optional>

#include "core/base/archive.hpp"

namespace treejet {

/// Part of the work that measuring the error may take.
constexpr double measuring_share = 0.04;
/// Evaluations between two sorts of the points in space, while their number stays the same.
constexpr int sorted_every = 16;

class RebuildPolicy {
 public:
  /// Evaluations between two measurements; without it, as takes `measuring_share` of the work.
  explicit RebuildPolicy(std::optional<int> measured_every) : measured_every_(measured_every) {}

  struct Due {
    bool measurement, sort;
  };

  bool tuning_due(int n, bool direct) const {
    return chosen_for_ == 0 || differs_by(direct ? 0.1 : 0.5, n, chosen_for_);
  }

  /// At an evaluation of n points by the shape chosen, which took `work` when it was; `sample_pairs` are the
  /// direct pairs of a measurement.
  Due at_evaluation(int n, double work, double sample_pairs, bool otherwise_due = false) {
    ++since_measurement_;
    const bool measurement = otherwise_due ||
                             since_measurement_ >= measuring_interval(n, work, sample_pairs) ||
                             differs_by(0.05, n, measured_for_);
    const bool sort = measurement || ++since_sort_ >= sorted_every;
    if (sort) since_sort_ = 0;
    return {measurement, sort};
  }

  /// `own` of the n points are this rank's.
  void chosen(int n, int own) {
    measured(n, own);
    chosen_for_ = n;
    since_sort_ = 0;
  }

  void measured(int n, int own) {
    measured_for_ = n;
    own_measured_for_ = own;
    since_measurement_ = 0;
  }

  /// Whether this rank's part of the points has become another one, whose leaves stand elsewhere.
  bool recut(int own) const {
    constexpr int few = 4;
    return std::abs(own - own_measured_for_) > few && differs_by(0.1, own, own_measured_for_);
  }

  static bool differs_by(double part, int n, int before) { return std::abs(n - before) > part * before; }

  void visit(Archive& state) {
    state(chosen_for_, measured_for_, own_measured_for_, since_measurement_, since_sort_);
  }

 private:
  /// Evaluations between two measurements: one takes an evaluation of all points and the sample's direct
  /// sums.
  double measuring_interval(int n, double work, double sample_pairs) const {
    if (measured_every_) return *measured_every_;
    work *= double(n) / chosen_for_;
    return (work + sample_pairs) / (measuring_share * work);
  }

  std::optional<int> measured_every_;
  int chosen_for_ = 0, measured_for_ = 0, own_measured_for_ = 0;  ///< points
  int since_measurement_ = 0, since_sort_ = 0;
};

}  // namespace treejet
