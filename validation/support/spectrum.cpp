#include "validation/support/spectrum.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace treejet {

namespace {

using Samples = std::vector<std::complex<double>>;

/// Without its mean under the window: one over the whole record would leave a part of a circle whose period
/// does not divide it.
Samples windowed(const Samples& samples) {
  const auto n = static_cast<double>(samples.size());
  std::vector<double> window(samples.size());
  std::complex<double> mean = 0;
  for (std::size_t k = 0; k < window.size(); ++k) {
    window[k] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (double(k) + 0.5) / n);
    mean += window[k] * samples[k] / (n / 2);
  }
  Samples w(samples.size());
  for (std::size_t k = 0; k < w.size(); ++k) w[k] = (samples[k] - mean) * window[k];
  return w;
}

double power(const Samples& w) {
  return std::accumulate(w.begin(), w.end(), 0.0, [](double sum, auto& z) { return sum + std::norm(z); });
}

/// In place. The only call of FFTW.
void transform(Samples& w) {
  auto* data = reinterpret_cast<fftw_complex*>(w.data());
  const fftw_plan plan =
      fftw_plan_dft_1d(static_cast<int>(w.size()), data, data, FFTW_FORWARD, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

}  // namespace

Spectrum spectrum(const std::vector<std::complex<double>>& samples, double spacing) {
  if (samples.size() < 8) throw std::invalid_argument("a spectrum needs eight samples");
  Samples w = windowed(samples);
  constexpr double round_off = 1e-26;  // square of some units in the last place
  const bool moves = power(w) > round_off * power(samples);
  transform(w);
  const auto n = static_cast<std::ptrdiff_t>(w.size()), negative = n / 2;
  std::rotate(w.begin(), w.end() - negative, w.end());

  Spectrum s;
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    s.frequency.push_back(double(k - negative) / (double(n) * spacing));
    s.power.push_back(std::norm(w[std::size_t(k)]));
  }
  const double all = std::accumulate(s.power.begin(), s.power.end(), 0.0);
  for (double& p : s.power) p = moves ? p / all : 0;
  if (!moves) return s;

  const auto peak = std::max_element(s.power.begin(), s.power.end()) - s.power.begin();
  double of_peak = 0;
  for (auto k = std::max<std::ptrdiff_t>(peak - 2, 0); k <= std::min(peak + 2, n - 1); ++k) {
    of_peak += s.power[std::size_t(k)];
    s.dominant += s.power[std::size_t(k)] * s.frequency[std::size_t(k)];
  }
  s.dominant /= of_peak;
  double square = 0;
  for (std::size_t k = 0; k < s.power.size(); ++k)
    square += s.power[k] * (s.frequency[k] - s.dominant) * (s.frequency[k] - s.dominant);
  s.spread = std::sqrt(square);
  return s;
}

}  // namespace treejet
