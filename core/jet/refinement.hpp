#pragma once
/// Splits elements of a jet, and merges them, conservatively.
///
/// Element e, of volume V and length l, between beads i (older) and j, is split at a new bead k:
///
///     V_k = V_i = V / 2                         of each half
///     r_k, v_k = sum w_n (r_n, v_n)         four-point rule: w_n = Lagrange's weights at the middle of the
///                                           element, in the volume between beads; (-1, 9, 9, -1) / 16 if
///                                           all are alike
///     sigma_i, sigma_k = sigma + and - d    d from the slope along the chain, as far as both halves stay
///                                           between the neighbours
///     m_k = m_i f_i / 2 + m_j f_j / 2       half of what belongs to the element, taken from its beads:
///                                           f_i = V / (V_below + V); charge likewise
///     v_i, v_j, v_k += u                    so that momentum is kept: u is of second order in l
///
/// The way along the chord at which k stands is bounded as the stress is, so that the stretches l / V of the
/// halves, and with them the radii sqrt(V / l), stay between those of the neighbours. At the free end, next
/// to the last row, and where the chain turns by more than 60 degrees at i or j, k is the middle of the chord
/// and both halves have the stress of the whole.
///
/// Merged are the two elements at a bead k: V and m_k, q_k go to the neighbours in the shares that a split
/// would take, sigma is the mean by volume, and v_i, v_j += u again. A merge undoes a split to round-off, but
/// for neighbours that are split at once.
///
/// Columns that a scene adds go as the stress does, but those of beads (core/jet/columns.hpp) as position and
/// velocity: interpolated at a split, left where they are at a merge, which takes those of bead k out.
///
/// Kept: sum of V, m, q and sigma V, linear momentum, all to round-off (to the bit for the first three while
/// volumes are 1, 1/2, 1/4, ...); of a jet that dries the volume at the nozzle, with it the polymer, and the
/// solvent; its momentum as if nothing had evaporated, for beads go by what the element above them has lost.
/// Not kept, by terms of second order in l: angular momentum, kinetic energy, energy of bending,
/// centre of mass; what would restore them is a kick at the scale of the elements. Scaled. Sources:
/// four-point rule: Dyn, Levin, Gregory, Comput. Aided Geom. Des. 4 (1987) 257; bounded slopes: van Leer, J.
/// Comput. Phys. 32 (1979) 101.

#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

/// Splits `elements`, ascending; of a jet of n rows none may be above n - 2. The new bead of element e is the
/// row above e. `of_beads`: columns of the state that are.
template <int D>
void split(Jet<D>& jet, const std::vector<Eigen::Index>& elements,
           const std::vector<Eigen::Index>& of_beads = {});

/// Takes out `beads`, ascending, no two of them neighbours, neither the first nor the last row.
template <int D>
void merge(Jet<D>& jet, const std::vector<Eigen::Index>& beads,
           const std::vector<Eigen::Index>& of_beads = {});

/// What is done to a jet at one moment, pass by pass: rows are those that the pass before has left.
struct RefinementPass {
  enum class Kind { split, merge } kind;
  std::vector<Eigen::Index> rows;
  std::vector<Eigen::Index> of_beads = {};
};
using Refinement = std::vector<RefinementPass>;

template <int D>
void refine(Jet<D>& jet, const RefinementPass& pass) {
  pass.kind == RefinementPass::Kind::split ? split(jet, pass.rows, pass.of_beads)
                                           : merge(jet, pass.rows, pass.of_beads);
}

template <int D>
void refine(Jet<D>& jet, const Refinement& refinement) {
  for (const RefinementPass& pass : refinement) refine(jet, pass);
}

}  // namespace treejet
