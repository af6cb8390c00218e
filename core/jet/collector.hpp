#pragma once
/// The collector: the plane x = H that takes beads away, oldest first. Scaled.

#include "core/jet/jet.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

class Collector {
 public:
  explicit Collector(const Parameters& p) : removing_(p.removing), distance_(groups(p).H) {}

  bool removing() const { return removing_; }
  double distance() const { return distance_; }

  /// Distance of a bead at x beyond the collector.
  double overdue(double x) const { return x - distance_; }

 private:
  bool removing_;
  double distance_;
};

}  // namespace treejet
