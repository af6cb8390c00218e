#pragma once
/// The solution between the two ends of a step: dense output for every scheme.
///
/// Position is the quintic that meets position, velocity and acceleration at both ends, velocity is its
/// derivative, stress the cubic that meets stress and its rate. With theta = (t - begin) / h and exact end
/// values the errors are O(h^6 theta^3 (1 - theta)^3) in position, O(h^5 theta^2 (1 - theta)^2) in velocity
/// and O(h^4 theta^2 (1 - theta)^2) in stress, also a little outside [0, 1]. The solution holds for begin <=
/// t <= until. Source: Hermite interpolation; e.g. Hairer, Norsett, Wanner, "Solving ODEs I", II.6.

#include "core/jet.hpp"

namespace treejet {

/// A point of the solution: the state with its slope.
template <int D>
struct Node {
  double t = 0;
  Table<D> y, slope;

  void visit(Archive& state) { state(t, y, slope); }
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
    const double h = end_.t - begin_.t, s = (t - begin_.t) / h, s2 = s * s, s3 = s2 * s;
    const Eigen::Index n = y.rows();
    const auto x0 = begin_.y.middleRows(first, n).template leftCols<D>();
    const auto x1 = end_.y.middleRows(first, n).template leftCols<D>();
    const auto v0 = begin_.y.middleRows(first, n).template middleCols<D>(D);
    const auto v1 = end_.y.middleRows(first, n).template middleCols<D>(D);
    const auto a0 = begin_.slope.middleRows(first, n).template middleCols<D>(D);
    const auto a1 = end_.slope.middleRows(first, n).template middleCols<D>(D);
    y.template leftCols<D>() = x0 + s3 * (10 - 15 * s + 6 * s2) * (x1 - x0) +
                               h * (s - s3 * (6 - 8 * s + 3 * s2)) * v0 - h * s3 * (4 - 7 * s + 3 * s2) * v1 +
                               h * h / 2 * (s2 - s3 * (3 - 3 * s + s2)) * a0 +
                               h * h / 2 * s3 * (1 - 2 * s + s2) * a1;
    y.template middleCols<D>(D) =
        30 * s2 * (1 - 2 * s + s2) / h * (x1 - x0) + (1 - s2 * (18 - 32 * s + 15 * s2)) * v0 -
        s2 * (12 - 28 * s + 15 * s2) * v1 + h * (s - s2 * (4.5 - 6 * s + 2.5 * s2)) * a0 +
        h * s2 * (1.5 - 4 * s + 2.5 * s2) * a1;
    constexpr int sigma = stress_column<D>;
    y.col(sigma) = (1 - s2 * (3 - 2 * s)) * begin_.y.col(sigma).segment(first, n) +
                   s2 * (3 - 2 * s) * end_.y.col(sigma).segment(first, n) +
                   h * s * (1 - 2 * s + s2) * begin_.slope.col(sigma).segment(first, n) -
                   h * s2 * (1 - s) * end_.slope.col(sigma).segment(first, n);
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
  const Node<D>& begin_;
  const Node<D>& end_;

 public:
  double until;  ///< end of validity: an event may have ended the step early
};

}  // namespace treejet
