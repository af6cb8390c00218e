#pragma once
/// The net Coulomb force on each bead from all other points of the chain, held bead and nozzle included:
///
///     a_i = (Q q_i / m_i) E_i ,      E_i = sum_{j != i} q_j (r_i - r_j) / |r_i - r_j|^3 .
///
/// `reach` is the deck's cutoff as a number of points along the chain: pairs with |i - j| <= reach interact.
/// The sum itself is forces/coulomb.hpp. Source: paper, Sec. "Equations of motion".

#include "forces/coulomb.hpp"
#include "forces/term.hpp"

namespace treejet {

template <int D>
class CoulombForce final : public ForceTerm<D> {
 public:
  CoulombForce(double Q, int reach) : Q_(Q), reach_(reach) {}
  std::string_view name() const override { return "Coulomb sum over all pairs"; }

  void prepare(const Chain<D>& c) override { field_.resize(c.beads, Eigen::NoChange); }

  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    PointCharges<D> points{{}, c.point_charge.data(), c.points()};
    FieldArrays<D> field;
    for (int k = 0; k < D; ++k) {
      points.r[k] = c.point.col(k).data();
      field[k] = field_.col(k).data();
    }
    if (reach_ < c.points() - 1) {
      coulomb_plain<D>(points, rows, field, reach_);
    } else {
      coulomb_direct<D>(points, rows, field);
    }
    const int i = rows.first, n = rows.size();
    for (int k = 0; k < D; ++k) {
      a.col(k).segment(i, n) +=
          Q_ * c.point_charge.segment(i, n) * c.inverse_mass.segment(i, n) * field_.col(k).segment(i, n);
    }
  }

  double Q() const { return Q_; }

  /// E at the beads, as `add` last computed it.
  const typename Chain<D>::Points& field() const { return field_; }

 private:
  double Q_;
  int reach_;
  mutable typename Chain<D>::Points field_;  ///< each row is written and read by its owner only
};

}  // namespace treejet
