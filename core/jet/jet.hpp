#pragma once
/// The jet: a table of beads, everything scaled (core/jet/scales.hpp).
///
///     collector                                             nozzle
///        |     o-----------o--------o-----o----o - - (o) - - |>
///        |   bead 0      bead 1              bead n-1  held
///              element 0     element 1 ...      element n-1
///
/// Row 0 is the oldest bead, the one nearest to the collector; row n-1 is the youngest. Element i joins bead
/// i to its upper neighbour, bead i+1 or, for i = n-1, the nozzle, and owns the stress sigma_i. Insertion
/// appends a row, removal drops row 0. The nozzle and the bead held below it are boundary conditions,
/// functions of time and of bead n-1 (core/jet/nozzle.hpp), and therefore not rows. Source: paper, Sec.
/// "Equations of motion" and "Jet insertion".

#include <cstdint>

#include "core/base/archive.hpp"
#include "core/base/vec.hpp"

namespace treejet {

template <int D>
struct Jet {
  double t = 0;
  State<D> y;
  Eigen::ArrayXd mass, charge;
  bool held = false;  ///< a bead waits at distance l_step below the nozzle, its charge fading in
  std::int64_t removed =
      0;  ///< beads that have left at the collector: bead i was the (removed + i)-th inserted

  Eigen::Index size() const { return y.rows(); }

  void visit(Archive& state) { state(t, y, mass, charge, held, removed); }
};

/// Appends a bead above the youngest one.
template <int D>
void append(Jet<D>& jet, const Vec<D>& position, const Vec<D>& velocity, double stress, double mass,
            double charge) {
  const Eigen::Index n = jet.size();
  jet.y.conservativeResize(n + 1, Eigen::NoChange);
  jet.y.row(n) << position.transpose().array(), velocity.transpose().array(), stress;
  jet.mass.conservativeResize(n + 1);
  jet.charge.conservativeResize(n + 1);
  jet.mass[n] = mass;
  jet.charge[n] = charge;
}

/// Drops the oldest bead.
template <int D>
void drop_first(Jet<D>& jet) {
  drop_first_row(jet.y);
  drop_first_row(jet.mass);
  drop_first_row(jet.charge);
  ++jet.removed;
}

}  // namespace treejet
