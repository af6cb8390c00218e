#pragma once
/// The equations of motion at two rates: beads near the two ends of the jet are fast, the others slow.
///
/// Over a few steps the field of far beads and the whole slope of slow beads change smoothly, so both are
/// continued in time by the parabola through their last three full evaluations. At a stage of a step only the
/// fast beads are computed:
///
///     fast bead    local terms + field of the points near to its end of the chain + continued field of the
///     rest slow bead    continued acceleration and stress rate both         field of the held bead, whose
///     charge rises too fast to be continued
///
/// A full evaluation is made at an accepted point of the solution once the interval since the last one is
/// over. There the continued values meet the true ones: their difference times the interval, in the norm of
/// the step control, is the error of the method, of fourth order in the interval, and sets the next interval.
/// So beads that come close in space, though far along the chain, shorten the interval. At a removal and a
/// release the remembered values are repaired as if the bead had always been absent or present; the past of a
/// released bead is the straight way on which it left. Source: multiple time stepping; e.g. Hairer, Norsett,
/// Wanner, "Solving ODEs I", III.1 (continuation of the slope).

#include <array>

#include "core/error_norm.hpp"
#include "forces/equations_of_motion.hpp"

namespace treejet {

/// A full evaluation, remembered, without what the held bead did.
template <int D>
struct Moment {
  using Points = typename Chain<D>::Points;
  double t = 0;
  Points point;  ///< beads, nozzle
  Eigen::ArrayXd point_charge;
  Points field;  ///< E at the beads, of all points
  Points far;    ///< E at the fast beads, of the points that are not near
  Eigen::Array<double, Eigen::Dynamic, D + 1> slope;  ///< acceleration and stress rate

  void visit(Archive& state) { state(t, point, point_charge, field, far, slope); }
};

template <int D>
class TwoRateMotion final : public Motion<D> {
 public:
  /// The norm is that of the step control; the error of the continuation is held to a part of what it
  /// permits.
  TwoRateMotion(EquationsOfMotion<D>& full, const ErrorNorm& norm) : full_(full), norm_(norm) {}

  void operator()(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) override;
  void at_node(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope) override;
  void before_removal(const Jet<D>& jet) override;
  void after_release(const Jet<D>& jet) override;

  void visit(Archive& state) override { state(full_, past_, remembered_, interval_, specific_charge_, full_evaluations_); }

  std::int64_t full_evaluations() const { return full_evaluations_; }

 private:
  static constexpr int moments = 3;
  using Points = typename Chain<D>::Points;
  using Weights = std::array<double, moments>;

  bool continues(Eigen::Index beads) const;
  void continued(const Jet<D>& jet, double t, const Table<D>& y, Table<D>& slope);
  void set_slow(const Weights& w, Rows slow, const Table<D>& y, Table<D>& slope) const;
  void accelerate(Rows rows, Table<D>& slope) const;
  Weights weights(double t) const;
  template <class Array>
  auto continuation(const Weights& w, Array Moment<D>::*table, Rows rows) const;
  Moment<D> moment(const Jet<D>& jet, double t, const Table<D>& slope) const;
  double mismatch(const Jet<D>& jet, double t, const Table<D>& y, const Moment<D>& now) const;
  void remember(Moment<D>&& now);
  void set_far(Moment<D>& moment) const;

  EquationsOfMotion<D>& full_;
  ErrorNorm norm_;
  std::array<Moment<D>, moments> past_;  ///< newest first
  int remembered_ = 0;
  double interval_ = 0;
  Chain<D> chain_;
  Points field_;                    ///< of this stage
  Eigen::ArrayXd specific_charge_;  ///< Q q / m of the beads, as the last node had them
  std::int64_t full_evaluations_ = 0;
};

}  // namespace treejet
