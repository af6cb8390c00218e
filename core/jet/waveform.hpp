#pragma once
/// How the potential goes with time: its factor w(t), and the direction of a field that rotates.
///
/// With the phase theta = 2 pi f t + phi
///
///     constant    1
///     sine        sin theta
///     square      1 while sin theta > 0, else 0
///     rc          the square wave behind a resistor and a capacitor, w' = (square - w) / T from w = 0
///     restart     the same as JETSPIN has it: each half begins anew, 1 - exp(-s / T) and exp(-s / T), s the
///                 time since it began
///     ramp        t / T up to t = T, then 1
///     table       straight between the points (t, w) of the deck, constant before and after
///     rotating    1, and the field is (E_x, E_y cos theta, E_z sin theta)
///
/// A wave with jumps or bends is smooth within pieces; `smooth_from` chooses the piece, whose continuation is
/// given for any time. Times are scaled. Source: JETSPIN 1.21 and 2.0 beta, `external potential type`.

#include <array>
#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

class Waveform {
 public:
  Waveform() = default;  ///< constant
  explicit Waveform(const Parameters& p);

  double operator()(double t) const;

  /// What the components of a field are multiplied with: that of a rotating one turns around the axis.
  std::array<double, 3> direction(double t) const;

  /// The piece that begins at t, or that t lies in; returns where it ends.
  double smooth_from(double t);

  /// Whether the field is a polynomial of low degree in each piece, which multirate may extrapolate.
  bool extrapolates() const;

 private:
  double phase(double t) const { return angular_frequency_ * t + phase_; }
  double start(double half_period) const;
  double charged_at(double half_period) const;
  double half_period_from(double t);
  double stretch_from(double t);

  Wave wave_ = Wave::constant;
  double angular_frequency_ = 0, phase_ = 0, time_ = 1;
  std::vector<double> at_, factor_;  ///< of the table
  // the piece: a half period begun at `begin_` with the capacitor at `charged_`, or a line
  bool on_ = true;
  double begin_ = 0, charged_ = 0, value_ = 1, slope_ = 0;
};

}  // namespace treejet
