#pragma once
/// Logarithm and exponential of doubles without branches and tables, so that a loop over them vectorises
/// (core/base/simd_clones.hpp). Errors: a few units in the last place of the larger of result and 1.

#include <bit>
#include <cstdint>

namespace treejet {

/// ln x, x positive and normal: x = 2^k m, m from sqrt(1/2) to sqrt(2), ln m = 2 artanh((m - 1) / (m + 1)).
[[gnu::always_inline]] inline double wide_log(double x) {
  constexpr std::uint64_t one = 0x3ff0000000000000, root_half = 0x3fe6a09e667f3bcd,
                          mantissa = 0x000fffffffffffff, two_52 = 0x4330000000000000;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (one - root_half);
  const double k = std::bit_cast<double>((bits >> 52) | two_52) - (4503599627370496.0 + 1023.0);
  const double m = std::bit_cast<double>((bits & mantissa) + root_half);
  const double s = (m - 1) / (m + 1), z = s * s;
  double sum = 1.0 / 21;
  for (int n = 19; n >= 3; n -= 2) sum = sum * z + 1.0 / n;
  constexpr double ln2_high = 0x1.62e42fefa38p-1, ln2_low = 0x1.ef35793c7673p-45;
  return k * ln2_high + (2 * s + (2 * s * z * sum + k * ln2_low));
}

/// e^x for x <= 0; from -700 down e^-700.
[[gnu::always_inline]] inline double wide_exp(double x) {
  constexpr double shift = 0x1.8p52, inverse_ln2 = 0x1.71547652b82fep0;
  constexpr double ln2_high = 0x1.62e42fefa38p-1, ln2_low = 0x1.ef35793c7673p-45;
  const double y = x < -700 ? -700 : x, shifted = y * inverse_ln2 + shift, k = shifted - shift;
  const double r = (y - k * ln2_high) - k * ln2_low;
  double sum = 1;
  for (int n = 13; n >= 1; --n) sum = 1 + sum * r * (1.0 / n);
  const std::uint64_t power = std::bit_cast<std::uint64_t>(shifted) << 52;  // 2^k, but for the bias
  return sum * std::bit_cast<double>(power + 0x3ff0000000000000);
}

}  // namespace treejet
