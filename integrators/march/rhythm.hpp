#pragma once
/// The rhythm in which a jet inserts beads: how long it is from a placement to the release, and from there to
/// the next placement.
///
/// A jet that has settled repeats both to parts in a thousand. Their straight continuation then tells the
/// next event from a whole interval away, better than the motion of the youngest bead does
/// (integrators/march/forecast.hpp), whose acceleration is about to change. Scaled times.

#include <array>
#include <cmath>
#include <optional>

#include "core/base/archive.hpp"

namespace treejet {

class Rhythm {
 public:
  /// An insertion event at t, the end of an interval with or without a held bead.
  void insertion(bool held, double t) {
    Interval& ended = interval_[held];
    ended.before = ended.last;
    ended.last = t - since_;
    since_ = t;
  }

  /// When the interval under way will end, once the intervals of its kind have become regular.
  std::optional<double> next(bool held) const {
    constexpr double regular = 0.02;
    const Interval& i = interval_[held];
    if (!(std::abs(i.last - i.before) < regular * i.last)) return std::nullopt;
    return since_ + 2 * i.last - i.before;
  }

  void visit(Archive& state) { state(interval_, since_); }

 private:
  struct Interval {
    double last = 0, before = 0;
  };
  std::array<Interval, 2> interval_;  ///< the last two without and with a held bead
  double since_ = 0;
};

}  // namespace treejet
