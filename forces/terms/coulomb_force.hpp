#pragma once
/// The net Coulomb force on each bead from all other points of the chain, held bead and nozzle included:
///
///     a_i = (Q q_i / m_i) E_i ,      E_i = sum_{j != i} q_j (r_i - r_j) / |r_i - r_j|^3 .
///
/// A field solver computes E (forces/coulomb/solver/field_solver.hpp): the direct sum, in which only pairs
/// with |i - j| <= `reach`, the deck's cutoff as a number of points along the chain, interact, or in three
/// dimensions a tree to a stated error. Source: paper, Sec. "Equations of motion".

#include <memory>

#include "core/base/error.hpp"
#include "forces/coulomb/solver/direct_sum.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class CoulombForce final : public ForceTerm<D> {
 public:
  CoulombForce(double Q, std::unique_ptr<FieldSolver<D>> solver) : Q_(Q), solver_(std::move(solver)) {}
  CoulombForce(double Q, int reach, const Ranks& ranks = {})
      : CoulombForce(Q, std::make_unique<DirectSum<D>>(reach, ranks)) {}

  std::string_view name() const override { return solver_->name(); }

  /// At a held bead that has a mass, too.
  void prepare(const Chain<D>& c, Rows, Threads threads) override {
    field_.resize(c.points(), Eigen::NoChange);
    const PointCharges<D> points = {columns<D>(c.point), c.point_charge.data(), c.points()};
    const int at = c.held_mass > 0 ? c.beads + 1 : c.beads;
    solver_->field(points, {0, at}, columns<D>(field_), threads);
    if (solver_->report().coincident > 0) throw NumericalError("two beads of the jet are at one place");
  }

  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    const int i = rows.first, n = rows.size();
    for (int k = 0; k < D; ++k) {
      a.col(k).segment(i, n) +=
          Q_ * c.point_charge.segment(i, n) * c.inverse_mass.segment(i, n) * field_.col(k).segment(i, n);
    }
  }

  Vec<D> on_held(const Chain<D>& c) const override {
    if (c.held_mass <= 0) return Vec<D>::Zero();
    return Q_ * field_.row(c.beads).matrix().transpose();
  }

  void visit(Archive& state) { solver_->visit(state); }

  double Q() const { return Q_; }

  /// E at the beads (its first rows), as `prepare` last computed it.
  const typename Chain<D>::Points& field() const { return field_; }

  /// What is measured of the field, null if it is exact.
  const FieldErrorReport* error() const {
    const FieldErrorReport& error = solver_->report().error;
    return error.asked > 0 ? &error : nullptr;
  }

 private:
  double Q_;
  std::unique_ptr<FieldSolver<D>> solver_;
  typename Chain<D>::Points field_;
};

}  // namespace treejet
