#pragma once
/// The near field of a cell in single precision, twice as many pairs a register: for accuracies that can bear
/// it.
///
/// Positions are taken relative to the target cell's centre, in units of its size, before they are rounded;
/// what is lost is then about 1e-7 of the distance to the farthest source, not of the coordinates. On a
/// chain, where neighbours cancel, this shows as a relative error of the field of 1e-5 (1e5 points) to 1e-4
/// (1e6 points).

#include "forces/coulomb/simd/p2p.hpp"

namespace treejet {
namespace {

/// (p - shift) unit, rounded, for `count` numbers.
template <class Registers>
void round_to_single(const double* p, int count, double shift, double unit, float* rounded) {
  for (int j = 0; j < count; j += Registers::lanes) {
    const auto value = (load_first<double, Registers::lanes>(p + j, count - j) - shift) * unit;
    const auto single = __builtin_convertvector(value, Wide<float, Registers::lanes>);
    store_lanes<float, Registers::lanes>(rounded + j, single, 0, count - j);
  }
}

/// Points rounded a chunk at a time.
struct SingleSources {
  static constexpr int most = 512;
  float x[3][most], q[most];
  const float* r[3] = {x[0], x[1], x[2]};

  template <class Registers>
  void round(const CellPoints& points, int first, int count, const NearUnits& unit) {
    for (int k = 0; k < 3; ++k)
      round_to_single<Registers>(points.r[k] + first, count, unit.centre[k], 1 / unit.length, x[k]);
    round_to_single<Registers>(points.q + first, count, 0, 1 / unit.charge, q);
  }
};

template <class Registers>
void p2p_single(const CellPoints& target, const CellRange* source, int count, const NearUnits& unit,
                double* const* field) {
  using Block = DirectBlock<Registers, 3, float>;
  const double to_field = unit.charge / (unit.length * unit.length);
  for (int first = target.first; first < target.first + target.count; first += Block::size) {
    const int left = target.first + target.count - first, used = left < Block::size ? left : Block::size;
    SingleSources rounded;
    rounded.template round<Registers>(target, first, used, unit);
    Block block(rounded.r, 0, used);
    for (int s = 0; s < count; ++s)
      for (int from = source[s].first; from < source[s].last; from += SingleSources::most) {
        const int rest = source[s].last - from,
                  some = rest < SingleSources::most ? rest : SingleSources::most;
        rounded.template round<Registers>(target, from, some, unit);
        block.add_range(rounded.r, rounded.q, {0, some}, {first - from, first - from + used});
      }
    float E[3][Block::size];
    float* const places[3] = {E[0], E[1], E[2]};
    block.store(places, 0, {0, Block::size});
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < used; ++l) field[k][first + l] = to_field * static_cast<double>(E[k][l]);
  }
}

}  // namespace
}  // namespace treejet
