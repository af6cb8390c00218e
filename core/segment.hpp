#pragma once
/// The solution between the two ends of a step: dense output for every scheme.
///
/// Position is the quintic that meets position, velocity and acceleration at both ends, velocity is its derivative,
/// stress the cubic that meets stress and its rate. With theta = (t - begin) / h and exact end values the errors are
/// O(h^6 theta^3 (1 - theta)^3) in position, O(h^5 theta^2 (1 - theta)^2) in velocity and O(h^4 theta^2 (1 - theta)^2)
/// in stress, also a little outside [0, 1]. The solution holds for begin <= t <= until.
/// Source: Hermite interpolation; e.g. Hairer, Norsett, Wanner, "Solving ODEs I", II.6.

#include "core/jet.hpp"

namespace treejet {

/// A point of the solution: the state with its slope.
template <int D>
struct Node {
  double t = 0;
  Table<D> y, slope;
};

template <int D>
class Segment {
 public:
  Segment(const Node<D>& begin, const Node<D>& end) : begin_(begin), end_(end), until(end.t) {}

  double begin() const { return begin_.t; }
  const Table<D>& first() const { return begin_.y; }

  Table<D> at(double t) const {
    Table<D> y(begin_.y.rows(), 2 * D + 1);
    at(t, 0, y);
    return y;
  }

  /// Beads first, first + 1, ... of the state at t, as many as `y` has rows.
  void at(double t, Eigen::Index first, Table<D>& y) const {
    const double h = end_.t - begin_.t, s = (t - begin_.t) / h;
    const Eigen::Index n = y.rows();
    const auto x0 = begin_.y.middleRows(first, n), x1 = end_.y.middleRows(first, n);
    const auto d0 = begin_.slope.middleRows(first, n), d1 = end_.slope.middleRows(first, n);
    constexpr int v = velocity_column<D>;
    for (int k = 0; k < D; ++k) {
      // remainders of position, velocity and acceleration at the end, beyond the parabola from the beginning
      const auto A = x1.col(k) - x0.col(k) - h * x0.col(v + k) - h * h / 2 * d0.col(v + k);
      const auto B = h * (x1.col(v + k) - x0.col(v + k)) - h * h * d0.col(v + k);
      const auto C = h * h * (d1.col(v + k) - d0.col(v + k));
      const auto c3 = 10 * A - 4 * B + C / 2, c4 = -15 * A + 7 * B - C, c5 = 6 * A - 3 * B + C / 2;
      y.col(k) = x0.col(k) + s * h * x0.col(v + k) + s * s * h * h / 2 * d0.col(v + k) +
                 s * s * s * (c3 + s * (c4 + s * c5));
      y.col(v + k) = x0.col(v + k) + s * h * d0.col(v + k) + s * s * (3 * c3 + s * (4 * c4 + s * 5 * c5)) / h;
    }
    const auto sigma0 = x0.col(stress_column<D>), sigma1 = x1.col(stress_column<D>);
    const auto rate0 = h * d0.col(stress_column<D>), rate1 = h * d1.col(stress_column<D>);
    const auto rise = sigma1 - sigma0;
    y.col(stress_column<D>) =
        sigma0 + s * (rate0 + s * (3 * rise - 2 * rate0 - rate1 + s * (rate0 + rate1 - 2 * rise)));
  }

  /// Third derivative of the position of bead i at the end: what the next step may expect of its acceleration.
  Vec<D> jerk_at_end(Eigen::Index i) const {
    const double h = end_.t - begin_.t;
    const Vec<D> v0 = h * velocity<D>(begin_.y, i), a0 = h * h * velocity<D>(begin_.slope, i);
    const Vec<D> A = position<D>(end_.y, i) - position<D>(begin_.y, i) - v0 - a0 / 2;
    const Vec<D> B = h * velocity<D>(end_.y, i) - v0 - a0, C = h * h * velocity<D>(end_.slope, i) - a0;
    return (60 * A - 36 * B + 9 * C) / (h * h * h);
  }

 private:
  const Node<D>& begin_;
  const Node<D>& end_;

 public:
  double until;  ///< end of validity: an event may have ended the step early
};

}  // namespace treejet
