#pragma once
/// The direct Coulomb sum over one block of targets held in registers, sources broadcast one after the other:
///
///     E_i = sum_j q_j |d|^-3 d,   d = r_i - r_j,   j ascending.
///
/// Blocks have `Isa::lanes * Isa::groups` targets and start at multiples of that number counted from row 0,
/// also when `rows` starts elsewhere, so the bits of a row do not depend on who asks for it. Only the block's
/// own points can be the target itself; the pair (i, i) is masked there, by index: distinct points at one
/// place give 0 * infinity, hence a field that is not finite. `Isa` brings q d2^(-3/2) (wide_*.cpp).

#include "forces/wide.hpp"
#include "parallel/rows.hpp"

namespace treejet {
namespace {

template <class Isa, int D>
struct DirectBlock {
  static constexpr int lanes = Isa::lanes, groups = Isa::groups, size = lanes * groups;
  using Pack = Wide<double, lanes>;
  Pack r[D][groups], e[D][groups];

  /// Adds the field of source j; `self` is its place in the block if it is one of the targets.
  template <bool own>
  void add(const double* const* source, double q, int j, int self) {
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      Pack d[D], d2{};
      for (int k = 0; k < D; ++k) {
        d[k] = r[k][g] - source[k][j];
        d2 += d[k] * d[k];
      }
      Pack w = Isa::over_cube(q, d2);
      if (own) w = count_from<lanes>(g * lanes) == self ? Pack{} : w;
      for (int k = 0; k < D; ++k) e[k][g] += w * d[k];
    }
  }
};

template <class Isa, int D>
void direct(const double* const* r, const double* q, int n, Rows rows, double* const* field) {
  using Block = DirectBlock<Isa, D>;
  for (int first = rows.first / Block::size * Block::size; first < rows.last; first += Block::size) {
    Block block;
    for (int k = 0; k < D; ++k)
      for (int g = 0; g < Block::groups; ++g) {
        const int at = first + g * Block::lanes;
        block.r[k][g] = load_first<double, Block::lanes>(r[k] + at, n - at);
        block.e[k][g] = Wide<double, Block::lanes>{};
      }

    const int end = n < first + Block::size ? n : first + Block::size;
    for (int j = 0; j < first; ++j) block.template add<false>(r, q[j], j, 0);
    for (int j = first; j < end; ++j) block.template add<true>(r, q[j], j, j - first);
    for (int j = end; j < n; ++j) block.template add<false>(r, q[j], j, 0);

    for (int k = 0; k < D; ++k)
      for (int g = 0; g < Block::groups; ++g) {
        const int at = first + g * Block::lanes;
        store_lanes<double, Block::lanes>(field[k] + at, block.e[k][g], rows.first - at, rows.last - at);
      }
  }
}

}  // namespace
}  // namespace treejet
