#pragma once
/// A force term: what it adds to the acceleration of the beads.
///
/// A term works on a share of rows, so that one indirect call serves a whole loop. `prepare` runs once an
/// evaluation, before any `add`, and may use the threads it is given; `add` runs concurrently on disjoint
/// rows and writes those rows only. Scaled: the result is a force over the mass of the bead it acts on.

#include <algorithm>
#include <string_view>

#include "core/jet/chain.hpp"
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
  virtual void prepare(const Chain<D>&, Threads) {}
  virtual void add(const Chain<D>& chain, Rows rows, Acceleration<D>& a) const = 0;

  /// Adds what the term contributes to the tension's answer; nothing if its force is slow or not local.
  virtual void differentiate(const Chain<D>&, LocalJacobian<D>&) const {}
};

/// The constitutive equation: the rate of the stress of the elements in `rows`.
template <int D>
class StressLaw {
 public:
  virtual ~StressLaw() = default;
  virtual std::string_view name() const = 0;
  virtual void set(const Chain<D>& chain, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const = 0;

  /// The derivative of the rate of stress by the strain rate; that by the stress is -1 in every law here.
  virtual double by_strain_rate(const Chain<D>& chain, int element) const = 0;
};

}  // namespace treejet
