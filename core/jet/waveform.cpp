#include "core/jet/waveform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/jet/scales.hpp"

namespace treejet {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

bool is_on(double half_period) {
  return std::fmod(half_period, 2) == 0;
}

}  // namespace

Waveform::Waveform(const Parameters& p) : wave_(p.field_wave) {
  const double unit = scales(p).time;
  angular_frequency_ = 2 * std::numbers::pi * p.field_frequency.value_or(0) * unit;
  phase_ = p.field_phase;
  time_ = p.field_time.value_or(unit) / unit;
  if (wave_ == Wave::ramp) at_ = {0, time_}, factor_ = {0, 1};
  if (wave_ == Wave::table)
    for (std::size_t k = 0; k + 1 < p.field_table.size(); k += 2) {
      at_.push_back(p.field_table[k] / unit);
      factor_.push_back(p.field_table[k + 1]);
    }
}

double Waveform::operator()(double t) const {
  const double decay = std::exp(-(t - begin_) / time_);
  switch (wave_) {
    case Wave::sine:
      return std::sin(phase(t));
    case Wave::square:
      return on_ ? 1 : 0;
    case Wave::rc:
      return on_ ? 1 + (charged_ - 1) * decay : charged_ * decay;
    case Wave::restart:
      return on_ ? 1 - decay : decay;
    case Wave::ramp:
    case Wave::table:
      return value_ + slope_ * (t - begin_);
    default:
      return 1;
  }
}

std::array<double, 3> Waveform::direction(double t) const {
  if (wave_ != Wave::rotating) return {1, 1, 1};
  return {1, std::cos(phase(t)), std::sin(phase(t))};
}

bool Waveform::extrapolates() const {
  return wave_ == Wave::constant || wave_ == Wave::square || wave_ == Wave::ramp || wave_ == Wave::table;
}

double Waveform::smooth_from(double t) {
  if (wave_ == Wave::square || wave_ == Wave::rc || wave_ == Wave::restart) return half_period_from(t);
  if (wave_ == Wave::ramp || wave_ == Wave::table) return stretch_from(t);
  return never;
}

double Waveform::start(double half_period) const {
  return (half_period * std::numbers::pi - phase_) / angular_frequency_;
}

/// Half period k is that of phases from k pi to (k + 1) pi.
double Waveform::half_period_from(double t) {
  double k = std::floor(phase(t) / std::numbers::pi);
  if (start(k + 1) <= t) ++k;  // where the quotient is rounded down
  on_ = is_on(k);
  begin_ = start(k);
  if (wave_ == Wave::rc) {
    charged_ = charged_at(k);
    begin_ = std::max(begin_, 0.0);
  }
  return start(k + 1);
}

/// The capacitor as half period k begins; empty at time 0. In the end it is at e / (1 + e) whenever the wave
/// goes on and at 1 / (1 + e) whenever it goes off; each half period brings it nearer by the factor
/// e = exp(-half period / T).
double Waveform::charged_at(double k) const {
  const double first = std::floor(phase_ / std::numbers::pi);
  if (k <= first) return 0;
  const double e = std::exp(-std::numbers::pi / angular_frequency_ / time_);
  const auto in_the_end = [&](double half) { return (is_on(half) ? e : 1) / (1 + e); };
  const double after_first = is_on(first) ? 1 - std::exp(-start(first + 1) / time_) : 0;
  return in_the_end(k) + (after_first - in_the_end(first + 1)) * std::pow(e, k - first - 1);
}

/// Before the first point and after the last the factor stays.
double Waveform::stretch_from(double t) {
  const auto next = std::upper_bound(at_.begin(), at_.end(), t);
  const auto k = static_cast<std::size_t>(next - at_.begin());
  slope_ = 0;
  begin_ = t;
  if (next == at_.begin()) {
    value_ = factor_.front();
    return *next;
  }
  begin_ = at_[k - 1];
  value_ = factor_[k - 1];
  if (next == at_.end()) return never;
  slope_ = (factor_[k] - value_) / (*next - begin_);
  return *next;
}

}  // namespace treejet
