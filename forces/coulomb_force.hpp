#pragma once
/// The net Coulomb force on each bead from all other points of the chain, held bead and nozzle included:
///
///     a_i = (Q q_i / m_i) E_i ,      E_i = sum_{j != i} q_j (r_i - r_j) / |r_i - r_j|^3 .
///
/// The sum is direct (forces/coulomb.hpp) or to a stated error (forces/coulomb_solver.hpp, three dimensions
/// only). `reach` is the deck's cutoff as a number of points along the chain: pairs with |i - j| <= reach
/// interact. Source: paper, Sec. "Equations of motion".

#include <memory>

#include "core/error.hpp"
#include "forces/coulomb.hpp"
#include "forces/coulomb_solver.hpp"
#include "forces/term.hpp"
#include "parallel/threads.hpp"

namespace treejet {

template <int D>
class CoulombForce final : public ForceTerm<D> {
 public:
  CoulombForce(double Q, int reach) : Q_(Q), reach_(reach) {}
  CoulombForce(double Q, const CoulombRequest& request, Threads threads)
      : Q_(Q), reach_(0), solver_(std::make_unique<CoulombSolver>(request)), threads_(threads) {}

  std::string_view name() const override {
    return solver_ ? "Coulomb sum to a stated error" : "Coulomb sum over all pairs";
  }

  void prepare(const Chain<D>& c) override {
    field_.resize(c.beads, Eigen::NoChange);
    if constexpr (D == 3) {
      if (!solver_) return;
      solver_->field(charges(c), {0, c.beads}, field_arrays(), worthwhile(threads_, c.beads));
      if (solver_->report().coincident > 0) throw NumericalError("two beads of the jet are at one place");
    }
  }

  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    if (!solver_) sum_directly(c, rows);
    const int i = rows.first, n = rows.size();
    for (int k = 0; k < D; ++k) {
      a.col(k).segment(i, n) +=
          Q_ * c.point_charge.segment(i, n) * c.inverse_mass.segment(i, n) * field_.col(k).segment(i, n);
    }
  }

  double Q() const { return Q_; }

  /// E at the beads, as `add` last computed it.
  const typename Chain<D>::Points& field() const { return field_; }

  /// The error of a sum to a stated error, null if it is direct.
  const ForceError* error() const { return solver_ ? &solver_->report().error : nullptr; }

 private:
  static PointCharges<D> charges(const Chain<D>& c) {
    PointCharges<D> points{{}, c.point_charge.data(), c.points()};
    for (int k = 0; k < D; ++k) points.r[k] = c.point.col(k).data();
    return points;
  }

  FieldArrays<D> field_arrays() const {
    FieldArrays<D> field;
    for (int k = 0; k < D; ++k) field[k] = field_.col(k).data();
    return field;
  }

  void sum_directly(const Chain<D>& c, Rows rows) const {
    if (reach_ < c.points() - 1) {
      coulomb_plain<D>(charges(c), rows, field_arrays(), reach_);
    } else {
      coulomb_direct<D>(charges(c), rows, field_arrays());
    }
  }

  double Q_;
  int reach_;
  std::unique_ptr<CoulombSolver> solver_;
  Threads threads_;
  mutable typename Chain<D>::Points field_;  ///< each row is written and read by its owner only
};

}  // namespace treejet
