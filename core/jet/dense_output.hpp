#pragma once
/// The solution between the two ends of a step: dense output for every scheme.
///
/// Position is the quintic that meets position, velocity and acceleration at both ends, velocity is its
/// derivative, stress and every added column the cubic that meets value and rate. With theta = (t - begin) /
/// h and exact end values the errors are O(h^6 theta^3 (1 - theta)^3) in position, O(h^5 theta^2 (1 -
/// theta)^2) in velocity and O(h^4 theta^2 (1 - theta)^2) in stress, also a little outside [0, 1]. The
/// solution holds for begin <= t <= until. Source: Hermite interpolation; e.g. Hairer, Norsett, Wanner,
/// "Solving ODEs I", II.6.

#include <utility>

#include "core/base/row_sharing.hpp"
#include "core/base/weighted_sum.hpp"
#include "core/jet/jet.hpp"

namespace treejet {

template <int D>
class DenseOutput {
 public:
  /// The two ends outlive it.
  DenseOutput(const SolutionPoint<D>& begin, const SolutionPoint<D>& end,
              RowSharing rows_shared = all_at_once)
      : begin_(begin), end_(end), rows_shared_(std::move(rows_shared)), until(end.t) {}

  double begin() const { return begin_.t; }
  const State<D>& first() const { return begin_.y; }
  const SolutionPoint<D>& from() const { return begin_; }
  const SolutionPoint<D>& to() const { return end_; }

  /// The state of all beads at t.
  State<D> at(double t) const {
    State<D> y(begin_.y.rows(), begin_.y.cols());
    for_each_stretch(rows_shared_, y.rows(),
                     [&](Eigen::Index first, Eigen::Index count) { set_all(t, first, count, y, first); });
    return y;
  }

  /// Beads first, first + 1, ... of the state at t, as many as `y` has rows.
  void at(double t, Eigen::Index first, State<D>& y) const { set_all(t, first, y.rows(), y, 0); }

  /// Positions alone of all beads; what else is in `y` means nothing then.
  void positions_at(double t, State<D>& y) const {
    y.resize(begin_.y.rows(), begin_.y.cols());
    for_each_stretch(rows_shared_, y.rows(), [&](Eigen::Index first, Eigen::Index count) {
      set_positions(t, first, count, y, first);
    });
  }

  /// Third derivative of the position of bead i at the end: what the next step may expect of its
  /// acceleration.
  Vec<D> jerk_at_end(Eigen::Index i) const {
    const double h = end_.t - begin_.t;
    const Vec<D> v0 = h * velocity<D>(begin_.y, i), a0 = h * h * velocity<D>(begin_.slope, i);
    const Vec<D> A = position<D>(end_.y, i) - position<D>(begin_.y, i) - v0 - a0 / 2;
    const Vec<D> B = h * velocity<D>(end_.y, i) - v0 - a0, C = h * h * velocity<D>(end_.slope, i) - a0;
    return (60 * A - 36 * B + 9 * C) / (h * h * h);
  }

 private:
  /// The state of `count` beads from `first` on, into as many rows of `y` from `row` on.
  void set_all(double t, Eigen::Index first, Eigen::Index count, State<D>& y, Eigen::Index row) const {
    set_positions(t, first, count, y, row);
    const double h = end_.t - begin_.t, s = (t - begin_.t) / h, s2 = s * s;
    const double v = 30 * s2 * (1 - 2 * s + s2) / h;
    const std::array<double, 6> of_velocity = {-v,
                                               v,
                                               1 - s2 * (18 - 32 * s + 15 * s2),
                                               -s2 * (12 - 28 * s + 15 * s2),
                                               h * (s - s2 * (4.5 - 6 * s + 2.5 * s2)),
                                               h * s2 * (1.5 - 4 * s + 2.5 * s2)};
    for (int k = 0; k < D; ++k)
      weighted_sum(nullptr, of_velocity, ends(k, first), count, y.col(velocity_column<D> + k).data() + row);
    const double c = s2 * (3 - 2 * s);
    for (Eigen::Index column = stress_column<D>; column < y.cols(); ++column) {
      const auto rows = [&](const State<D>& table) { return table.col(column).segment(first, count); };
      y.col(column).segment(row, count) = (1 - c) * rows(begin_.y) + c * rows(end_.y) +
                                          h * s * (1 - 2 * s + s2) * rows(begin_.slope) -
                                          h * s2 * (1 - s) * rows(end_.slope);
    }
  }

  void set_positions(double t, Eigen::Index first, Eigen::Index count, State<D>& y, Eigen::Index row) const {
    const double h = end_.t - begin_.t, s = (t - begin_.t) / h, s2 = s * s, s3 = s2 * s;
    const double x = s3 * (10 - 15 * s + 6 * s2);
    const std::array<double, 6> of_position = {1 - x,
                                               x,
                                               h * (s - s3 * (6 - 8 * s + 3 * s2)),
                                               -h * s3 * (4 - 7 * s + 3 * s2),
                                               h * h / 2 * (s2 - s3 * (3 - 3 * s + s2)),
                                               h * h / 2 * s3 * (1 - 2 * s + s2)};
    for (int k = 0; k < D; ++k)
      weighted_sum(nullptr, of_position, ends(k, first), count, y.col(k).data() + row);
  }

  /// What the quintic of a component is made of: position, velocity and acceleration at the two ends.
  std::array<const double*, 6> ends(int component, Eigen::Index first) const {
    const auto from = [&](const State<D>& table, int column) { return table.col(column).data() + first; };
    const int velocity = velocity_column<D> + component;
    return {from(begin_.y, component), from(end_.y, component),      from(begin_.y, velocity),
            from(end_.y, velocity),    from(begin_.slope, velocity), from(end_.slope, velocity)};
  }

  const SolutionPoint<D>& begin_;
  const SolutionPoint<D>& end_;
  RowSharing rows_shared_;

 public:
  double until;  ///< end of validity: an event may have ended the step early
};

}  // namespace treejet
