#pragma once
/// Random numbers without a state: Philox4x32-10, a bijection of 128-bit counters for each 64-bit key.
///
/// What is drawn depends on what it is drawn for alone, never on who draws, in what order or how often.
/// Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy as 1, 2, 3,
/// SC11 (2011).

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace treejet {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

constexpr PhiloxCounter philox(PhiloxCounter counter, PhiloxKey key) {
  constexpr int rounds = 10;
  constexpr std::uint64_t multiplier[] = {0xD2511F53, 0xCD9E8D57};
  constexpr std::uint32_t bump[] = {0x9E3779B9, 0xBB67AE85};
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t a = multiplier[0] * counter[0], b = multiplier[1] * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key = {key[0] + bump[0], key[1] + bump[1]};
  }
  return counter;
}

/// Two independent standard normal numbers for a subject, a node and a stream, by Box and Muller's method
/// from uniform numbers of 53 bits in (0, 1].
inline std::array<double, 2> normal_pair(int seed, std::uint32_t stream, std::int64_t subject,
                                         std::uint64_t node) {
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
  const auto who = static_cast<std::uint64_t>(subject);
  const PhiloxCounter bits =
      philox({low(who), high(who), low(node), high(node)}, {static_cast<std::uint32_t>(seed), stream});
  const auto uniform = [&](std::size_t k) {
    const std::uint64_t word = std::uint64_t{bits[k + 1]} << 32 | bits[k];
    return double((word >> 11) + 1) * 0x1p-53;
  };
  const double radius = std::sqrt(-2 * std::log(uniform(0))), angle = 2 * std::numbers::pi * uniform(2);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace treejet
