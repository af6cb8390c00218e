#pragma once
/// The direct Coulomb sum over one block of targets held in registers, sources broadcast one after the other:
///
///     E_i = sum_j q_j |d|^-3 d,   d = r_i - r_j,   j ascending,
///
/// and if wanted phi_i = sum_j q_j |d|^-1, which is then summed beside the components of E.
///
/// Blocks have `Isa::lanes * Isa::groups` targets, those of which no more than `Isa::lanes` are wanted one
/// group, and start at multiples of that number counted from row 0, also when `rows` starts elsewhere, so the
/// bits of a row do not depend on who asks for it. Only the block's own points can be the target itself; the
/// pair (i, i) is masked there, by index: distinct points at one place give 0 * infinity, hence a field that
/// is not finite. `Isa` brings q d2^(-3/2) (plain.cpp, avx2.cpp, avx512.cpp).

#include "forces/coulomb/simd/few_points.hpp"
#include "forces/coulomb/simd/layout.hpp"
#include "forces/coulomb/simd/register.hpp"
#include "parallel/rows.hpp"

namespace treejet {
namespace {

template <class Registers, int D, class T = double, bool potential = false, int groups = Registers::groups>
struct DirectBlock {
  static constexpr int lanes = Registers::lanes * static_cast<int>(sizeof(double) / sizeof(T));
  static constexpr int size = lanes * groups, sums = D + (potential ? 1 : 0);
  using Pack = Wide<T, lanes>;
  Pack r[D][groups], e[sums][groups];

  /// Targets first.. of n.
  DirectBlock(const T* const* target, int first, int n) {
    for (int k = 0; k < D; ++k)
      for (int g = 0; g < groups; ++g) {
        const int at = first + g * lanes;
        r[k][g] = load_first<T, lanes>(target[k] + at, n - at);
      }
    for (auto& sum : e)
      for (Pack& part : sum) part = Pack{};
  }

  /// Adds the field of the source j, not one of the targets, and to `back` what the targets, with charges
  /// `own`, do to it (Newton's third law): lane by lane, D registers.
  void add_mutual(const T* const* source, T q, int j, const Pack (&own)[groups], Pack* const back) {
    Pack reaction[D]{};
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      Pack d[D];
      const Pack d2 = separation(source, j, g, d);
      const Pack w = Registers::over_cube(1, d2), by_source = q * w, by_target = own[g] * w;
      for (int k = 0; k < D; ++k) {
        e[k][g] += by_source * d[k];
        reaction[k] += by_target * d[k];
      }
    }
    for (int k = 0; k < D; ++k) back[k] -= reaction[k];
  }

  /// d = r_i - r_j of a group of targets; the result is its square.
  Pack separation(const T* const* source, int j, int g, Pack (&d)[D]) const {
    Pack d2{};
    for (int k = 0; k < D; ++k) {
      d[k] = r[k][g] - source[k][j];
      d2 += d[k] * d[k];
    }
    return d2;
  }

  void store(T* const* field, int first, Rows rows) const {
    for (int k = 0; k < sums; ++k)
      for (int g = 0; g < groups; ++g) {
        const int at = first + g * lanes;
        store_lanes<T, lanes>(field[k] + at, e[k][g], rows.first - at, rows.last - at);
      }
  }

  /// Adds the field of the sources first <= j < last, the block itself being `own`.
  void add_range(const T* const* source, const T* q, Rows range, Rows own) {
    const int begin = range.first > own.first ? range.first : own.first;
    const int end = range.last < own.last ? range.last : own.last;
    const int before = range.last < own.first ? range.last : own.first;
    const int after = range.first > own.last ? range.first : own.last;
    for (int j = range.first; j < before; ++j) add<false>(source, q[j], j, 0);
    for (int j = begin; j < end; ++j) add<true>(source, q[j], j, j - own.first);
    for (int j = after; j < range.last; ++j) add<false>(source, q[j], j, 0);
  }

  /// Adds the field of source j; `self` is its place in the block if it is one of the targets.
  template <bool own>
  void add(const T* const* source, T q, int j, int self) {
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      Pack d[D];
      const Pack d2 = separation(source, j, g, d);
      Pack w = Registers::over_cube(q, d2);
      if (own) w = count_from<T, lanes>(g * lanes) == self ? Pack{} : w;
      for (int k = 0; k < D; ++k) e[k][g] += w * d[k];
      if (potential) e[sums - 1][g] += w * d2;
    }
  }
};

template <class Block>
void direct_block_of(const double* const* r, const double* q, int n, int first, Rows rows,
                     double* const* field) {
  Block block(r, first, n);
  block.add_range(r, q, {0, n}, {first, n < first + Block::size ? n : first + Block::size});
  block.store(field, first, rows);
}

template <class Registers, int D, bool potential = false>
void direct(const double* const* r, const double* q, int n, Rows rows, double* const* field) {
  using Block = DirectBlock<Registers, D, double, potential>;
  using OneGroup = DirectBlock<Registers, D, double, potential, 1>;
  for (int first = rows.first / Block::size * Block::size; first < rows.last; first += Block::size) {
    if (rows.last - first <= OneGroup::size)
      direct_block_of<OneGroup>(r, q, n, first, rows, field);
    else
      direct_block_of<Block>(r, q, n, first, rows, field);
  }
}

/// The whole field of few points, each pair worked out once. Rows of the result are not independent of each
/// other, so this is one worker's job.
template <class Registers, int D>
void direct_mutual(const double* const* r, const double* q, int n, double* const* field) {
  using Block = DirectBlock<Registers, D>;
  using Pack = typename Block::Pack;
  constexpr int lanes = Block::lanes;
  Pack back[few_points + lanes][D];  // what earlier blocks do to a point, lane by lane
  for (int j = 0; j < n + lanes; ++j)
    for (int k = 0; k < D; ++k) back[j][k] = Pack{};

  for (int first = 0; first < n; first += Block::size) {
    const Rows own = {first, n < first + Block::size ? n : first + Block::size};
    Block block(r, first, n);
    block.add_range(r, q, own, own);
    Pack charge[Registers::groups];
    for (int g = 0; g < Registers::groups; ++g)
      charge[g] = load_first<double, lanes>(q + first + g * lanes, n - first - g * lanes);
    for (int j = own.last; j < n; ++j) block.add_mutual(r, q[j], j, charge, back[j]);
    block.store(field, first, own);
  }
  for (int first = 0; first < n; first += lanes)
    for (int k = 0; k < D; ++k) {
      Pack row[lanes], sum = load_first<double, lanes>(field[k] + first, n - first);
      for (int l = 0; l < lanes; ++l) row[l] = back[first + l][k];
      Registers::transpose(row);
      for (int l = 0; l < lanes; ++l) sum += row[l];
      store_lanes<double, lanes>(field[k] + first, sum, 0, n - first);
    }
}

/// The near field of the points of a cell: sources are the points of `count` ranges, in their order.
template <class Registers, bool potential = false>
void p2p(const CellPoints& target, const CellRange* source, int count, double* const* field) {
  using Block = DirectBlock<Registers, 3, double, potential>;
  const int end = target.first + target.count;
  for (int first = target.first; first < end; first += Block::size) {
    Block block(target.r, first, end);
    const Rows own = {first, end < first + Block::size ? end : first + Block::size};
    for (int k = 0; k < count; ++k)
      block.add_range(target.r, target.q, {source[k].first, source[k].last}, own);
    block.store(field, first, own);
  }
}

}  // namespace
}  // namespace treejet
