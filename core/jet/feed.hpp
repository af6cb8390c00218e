#pragma once
/// How the fluid of a nozzle becomes beads: by the pull of the jet (core/jet/feed_by_pull.hpp, the paper's
/// rule) or by a given flow (core/jet/feed_by_flow.hpp).
///
/// Both hold a bead on the chord from the nozzle to the youngest bead, the next to be released. Insertion is
/// up to two events, zeros of `overdue`: place begins to hold a bead, release makes it the youngest row. All
/// scaled: a volume of 1 is that of an element as it leaves the nozzle.

#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

/// What stands between the youngest bead and the nozzle.
template <int D>
struct HeldBead {
  Vec<D> position = Vec<D>::Zero();
  double charge = 0;
  double mass = 0;  ///< and volume, fed since the last release; 0 of a bead that is a charge only
};

/// The nozzle at one instant.
template <int D>
struct Inlet {
  Vec<D> position, velocity;  ///< velocity: of its fluid
};

template <int D>
class FeedRule {
 public:
  virtual ~FeedRule() = default;

  /// Volume a time, 0 if the jet draws what it pulls.
  virtual double flow() const { return 0; }

  /// How far the next event is overdue, in the length of an element; `r`: of the youngest bead at t.
  virtual double overdue(const Jet<D>& jet, const Vec<D>& r, const Vec<D>& nozzle, double t) const = 0;

  virtual HeldBead<D> held(const Jet<D>& jet, const Vec<D>& r, const Vec<D>& nozzle, double t) const = 0;

  /// Volume that has been drawn out behind the youngest bead.
  virtual double drawn(const Jet<D>& jet, const Vec<D>& r, const Vec<D>& nozzle, double t) const = 0;

  /// The bead that is released; `at_birth`: values of the added columns. The jet is told what has changed but
  /// for the new row.
  virtual Bead<D> release(Jet<D>& jet, const Inlet<D>& inlet, const std::vector<double>& at_birth) const = 0;
};

}  // namespace treejet
