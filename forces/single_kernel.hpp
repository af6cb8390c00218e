#pragma once
/// The near field of a cell in single precision, twice as many pairs a register: for accuracies that can bear
/// it.
///
/// Positions are taken relative to the target cell's centre, in units of its size, before they are rounded;
/// what is lost is then about 1e-7 of the distance to the farthest source, not of the coordinates. On a
/// chain, where neighbours cancel, this shows as a relative error of the field of 1e-5 (1e5 points) to 1e-4
/// (1e6 points).

#include "forces/expansions.hpp"
#include "forces/wide.hpp"
#include "parallel/rows.hpp"

namespace treejet {
namespace {

/// Sources rounded a chunk at a time.
struct SingleSources {
  static constexpr int most = 512;
  float r[3][most], q[most];
};

template <class Isa>
struct SingleNear {
  static constexpr int lanes = 2 * Isa::lanes, groups = 2, size = lanes * groups;
  using Pack = Wide<float, lanes>;
  Pack r[3][groups], e[3][groups];

  template <bool own>
  void add(const SingleSources& source, int j, int self) {
#pragma GCC unroll 2
    for (int g = 0; g < groups; ++g) {
      Pack d[3], d2{};
      for (int k = 0; k < 3; ++k) {
        d[k] = r[k][g] - source.r[k][j];
        d2 += d[k] * d[k];
      }
      Pack w = Isa::over_cube(source.q[j], d2);
      if (own) {
        for (int l = 0; l < lanes; ++l) w[l] = g * lanes + l == self ? 0.0f : w[l];
      }
      for (int k = 0; k < 3; ++k) e[k][g] += w * d[k];
    }
  }
};

/// (p - shift) unit, rounded, for `count` numbers.
template <class Isa>
void round_to_single(const double* p, int count, double shift, double unit, float* rounded) {
  for (int j = 0; j < count; j += Isa::lanes) {
    const auto value = (load_first<double, Isa::lanes>(p + j, count - j) - shift) * unit;
    const auto single = __builtin_convertvector(value, Wide<float, Isa::lanes>);
    store_lanes<float, Isa::lanes>(rounded + j, single, 0, count - j);
  }
}

template <class Isa>
void p2p_single(const CellPoints& target, const CellRange* source, int count, const NearUnits& unit,
                double* const* field) {
  using Near = SingleNear<Isa>;
  const double over_length = 1 / unit.length, over_charge = 1 / unit.charge;
  const double to_field = unit.charge * over_length * over_length;
  for (int first = 0; first < target.count; first += Near::size) {
    const int used = target.count - first < Near::size ? target.count - first : Near::size;
    const int begin = target.first + first;
    float place[3][Near::size] = {};
    Near near{};
    for (int k = 0; k < 3; ++k) {
      round_to_single<Isa>(target.r[k] + begin, used, unit.centre[k], over_length, place[k]);
      for (int g = 0; g < Near::groups; ++g)
        near.r[k][g] = load<float, Near::lanes>(place[k] + g * Near::lanes);
    }
    for (int s = 0; s < count; ++s)
      for (int from = source[s].first; from < source[s].last; from += SingleSources::most) {
        const int left = source[s].last - from,
                  some = left < SingleSources::most ? left : SingleSources::most;
        SingleSources rounded;
        for (int k = 0; k < 3; ++k)
          round_to_single<Isa>(target.r[k] + from, some, unit.centre[k], over_length, rounded.r[k]);
        round_to_single<Isa>(target.q + from, some, 0, over_charge, rounded.q);
        for (int j = 0; j < some; ++j) {
          const int self = from + j - begin;
          if (self < 0 || self >= used)
            near.template add<false>(rounded, j, 0);
          else
            near.template add<true>(rounded, j, self);
        }
      }
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < used; ++l)
        field[k][begin + l] = to_field * static_cast<double>(near.e[k][l / Near::lanes][l % Near::lanes]);
  }
}

}  // namespace
}  // namespace treejet
