/// The spectrum of a displacement whose answer is known.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "validation/support/spectrum.hpp"

using namespace treejet;

namespace {

std::vector<std::complex<double>> circle(double frequency, double spacing, int n, double drift = 0) {
  std::vector<std::complex<double>> w;
  for (int k = 0; k < n; ++k) {
    const double t = spacing * k;
    w.push_back(std::polar(0.3, 2 * std::numbers::pi * frequency * t + 0.7) + std::complex{5.0, drift * t});
  }
  return w;
}

}  // namespace

TEST_CASE("A circle has its frequency with its sense, whether its period divides the record or not") {
  constexpr double spacing = 1e-3;
  constexpr int n = 500;
  for (const double f : {20.0, -20.0, 20.7, 133.3, -251.9}) {
    CAPTURE(f);
    const Spectrum s = spectrum(circle(f, spacing, n), spacing);
    // the bins beyond the second on each side hold 1e-3 of a Hann window's power at the worst
    CHECK(s.dominant == Approx(f).margin(5e-3 / (spacing * n)));
  }
}

TEST_CASE("The spread of a circle is that of the window, 1 / (sqrt(3) record)") {
  for (const int n : {256, 1000, 4096}) {
    const Spectrum s = spectrum(circle(40.3, 1e-3, n), 1e-3);
    // the window's second derivative jumps at the ends of the record, which adds 1 / n
    CHECK(s.spread == Approx(1 / (std::sqrt(3) * 1e-3 * n)).epsilon(5e-3));
  }
}

TEST_CASE("Two circles of powers a and b at +f and -f have the spread of two points") {
  constexpr int n = 4000;
  auto w = circle(50, 1e-3, n);
  const auto other = circle(-50, 1e-3, n);
  for (int k = 0; k < n; ++k) w[std::size_t(k)] += 0.5 * other[std::size_t(k)];
  const Spectrum s = spectrum(w, 1e-3);
  CHECK(s.dominant == Approx(50).margin(1e-3));
  // powers 1 and 1/4, 100 apart: 100 sqrt(1/5), beside the window's 0.14
  CHECK(s.spread == Approx(100 * std::sqrt(0.2)).epsilon(1e-4));
}

TEST_CASE("Powers add up to one, and a jet that hangs still has none") {
  const Spectrum s = spectrum(circle(12, 1e-3, 333), 1e-3);
  double sum = 0;
  for (const double p : s.power) sum += p;
  CHECK(sum == Approx(1).epsilon(1e-12));
  const Spectrum still = spectrum(std::vector<std::complex<double>>(64, {0.2, 0.1}), 1e-3);
  CHECK(still.spread == 0);
  CHECK_THROWS_AS(spectrum(std::vector<std::complex<double>>(7), 1e-3), std::invalid_argument);
}
