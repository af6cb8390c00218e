#pragma once
/// Multiples of an interval among floating-point numbers: the grid of fixed steps, of outputs, of
/// refinements.
///
/// k * interval, divided by the interval again, may come out beside k by as much as k times the round-off
/// of 1. What is so near to a multiple, or within a billionth of an interval, is at it.

#include <algorithm>
#include <cmath>
#include <limits>

namespace treejet {

/// How far from its multiple k a number may be, in intervals.
inline double multiple_round_off(double k) {
  return std::max(1e-9, 4 * std::numeric_limits<double>::epsilon() * std::abs(k));
}

/// The number of the last multiple that t is at or beyond.
inline double last_multiple(double t, double interval) {
  const double k = t / interval;
  return std::floor(k + multiple_round_off(k));
}

inline bool is_multiple(double t, double interval) {
  const double k = t / interval;
  return std::abs(k - std::round(k)) <= multiple_round_off(k);
}

}  // namespace treejet
