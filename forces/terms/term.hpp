#pragma once
/// A force term: what it adds to the acceleration of the beads.
///
/// A term works on a share of rows, so that one indirect call serves a whole loop. Its stencil: for row i it
/// reads beads i-1, i and i+1 (the nozzle or the held bead above the youngest), elements i-1 and i, time and
/// velocities (core/jet/chain.hpp); of all elements the volumes at the nozzle are known, and only the Coulomb
/// sum reads all beads. So multirate and subdomains may ask for
/// any range of rows, with no more than its neighbours set.
///
/// `prepare` runs before any `add` of the same evaluation, for ranges of rows that cover those of the `add`s,
/// and may use the threads it is given; what it sets for one range stands until the evaluation is over. `add`
/// runs concurrently on disjoint rows and writes those rows only. Scaled: the result is a force over the mass
/// of the bead it acts on.

#include <algorithm>
#include <limits>
#include <string_view>

#include "core/jet/chain.hpp"
#include "core/jet/columns.hpp"
#include "core/jet/local_jacobian.hpp"
#include "parallel/threads.hpp"

namespace treejet {

/// Fewer beads than this for each thread do not repay waking it: the Coulomb sum over 2 * 256 beads takes
/// about as long as a hundred wake-ups, so that a late one does no harm either.
constexpr int beads_worth_a_thread = 256;

inline Threads worthwhile(Threads threads, int beads) {
  return {std::clamp(beads / beads_worth_a_thread, 1, threads.count)};
}

/// The velocity columns of a slope table.
template <int D>
using Acceleration = Eigen::Ref<Eigen::Array<double, Eigen::Dynamic, D>, 0, Eigen::OuterStride<>>;

template <int D>
class ForceTerm {
 public:
  virtual ~ForceTerm() = default;
  virtual std::string_view name() const = 0;
  virtual void prepare(const Chain<D>&, Rows, Threads) {}
  virtual void add(const Chain<D>& chain, Rows rows, Acceleration<D>& a) const = 0;

  /// The acceleration of a held bead of charge over mass 1 (core/jet/feed_by_flow.hpp), left to itself; the
  /// tensions of the two halves of its element balance.
  virtual Vec<D> on_held(const Chain<D>&) const { return Vec<D>::Zero(); }

  /// Whether the force on a bead far from the ends, left to itself, changes so smoothly in time that
  /// multirate may extrapolate it over several steps.
  virtual bool extrapolates() const { return true; }

  /// A force that jumps or bends at certain times: from t on, until the time given back, `add` is to be the
  /// smooth continuation of the piece that begins at t, whatever the time of the stage. The march ends a step
  /// at that time and asks anew; multirate forgets what it remembers of the piece before.
  virtual double smooth_from(double /*t*/) { return std::numeric_limits<double>::infinity(); }

  /// Adds what the term contributes to the tension's answer, or to that of a bead's acceleration to its own
  /// velocity; nothing if its force is slow or not local.
  virtual void differentiate(const Chain<D>&, LocalJacobian<D>&) const {}
};

/// The constitutive equation: the rates of the stress of the elements in `rows`, and of the column that a law
/// may keep beside it, which is the first of the added ones.
template <int D>
class StressLaw {
 public:
  virtual ~StressLaw() = default;
  virtual std::string_view name() const = 0;
  virtual Columns columns() const { return {}; }
  virtual void set(const Chain<D>& chain, Rows rows, State<D>& slope) const = 0;
  virtual StressDerivative derivative(const Chain<D>& chain, int element) const = 0;

  /// As of a force term.
  virtual bool extrapolates() const { return true; }
};

/// The rate of a column that a scene adds to the state of its beads (core/jet/columns.hpp). Its stencil is
/// that of a force term.
template <int D>
class ColumnRate {
 public:
  virtual ~ColumnRate() = default;
  virtual Column column() const = 0;
  /// Changes the volumes of elements and the masses of beads in `rows` as the column asks for, before any
  /// force is evaluated.
  virtual void amend(Chain<D>&, int /*added*/, Rows) const {}
  /// `added`: the place of the column among the added ones.
  virtual void set(const Chain<D>& chain, int added, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const = 0;
};

}  // namespace treejet
