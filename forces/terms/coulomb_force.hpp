#pragma once
/// The net Coulomb force on each bead from all other points of the chain, held bead and nozzle included:
///
///     a_i = (Q q_i / m_i) E_i ,      E_i = sum_{j != i} q_j (r_i - r_j) / |r_i - r_j|^3 .
///
/// The sum is direct (forces/coulomb/coulomb.hpp) or to a stated error
/// (forces/coulomb/solver/coulomb_solver.hpp, three dimensions only), shared out among ranks. `reach` is the
/// deck's cutoff as a number of points along the chain: pairs with |i - j| <= reach interact. Source: paper,
/// Sec. "Equations of motion".

#include <memory>

#include "core/base/error.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "forces/terms/term.hpp"
#include "parallel/share_rows.hpp"

namespace treejet {

template <int D>
class CoulombForce final : public ForceTerm<D> {
 public:
  CoulombForce(double Q, int reach, const Ranks& ranks = {}) : Q_(Q), reach_(reach), ranks_(ranks) {}
  CoulombForce(double Q, const CoulombRequest& request, const Ranks& ranks = {})
      : Q_(Q),
        reach_(0),
        ranks_(ranks),
        solver_(std::make_unique<CoulombSolver>(request, default_isa(), ranks)) {}

  std::string_view name() const override {
    return solver_ ? "Coulomb sum to a stated error" : "Coulomb sum over all pairs";
  }

  void prepare(const Chain<D>& c, Rows, Threads threads) override {
    field_.resize(c.points(), Eigen::NoChange);
    const Rows beads = {0, c.beads};
    const FieldArrays<D> field = columns<D>(field_);
    if constexpr (D == 3) {
      if (solver_) {
        solver_->field(charges(c), beads, field, threads);
        if (solver_->report().coincident > 0) throw NumericalError("two beads of the jet are at one place");
        return;
      }
    }
    if (reach_ >= c.points() - 1 && c.points() <= few_points) return coulomb_mutual<D>(charges(c), field);
    share_rows(ranks_, threads, beads, direct_block, field, [&](Rows rows) { sum_directly(c, rows, field); });
  }

  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    const int i = rows.first, n = rows.size();
    for (int k = 0; k < D; ++k) {
      a.col(k).segment(i, n) +=
          Q_ * c.point_charge.segment(i, n) * c.inverse_mass.segment(i, n) * field_.col(k).segment(i, n);
    }
  }

  void visit(Archive& state) {
    if (solver_) state(*solver_);
  }

  double Q() const { return Q_; }

  /// E at the beads (its first rows), as `prepare` last computed it.
  const typename Chain<D>::Points& field() const { return field_; }

  /// The error of a sum to a stated error, null if it is direct.
  const FieldErrorReport* error() const { return solver_ ? &solver_->report().error : nullptr; }

 private:
  static PointCharges<D> charges(const Chain<D>& c) {
    return {columns<D>(c.point), c.point_charge.data(), c.points()};
  }

  void sum_directly(const Chain<D>& c, Rows rows, const FieldArrays<D>& field) const {
    if (reach_ < c.points() - 1) {
      coulomb_plain<D>(charges(c), rows, field, reach_);
    } else {
      coulomb_direct<D>(charges(c), rows, field);
    }
  }

  double Q_;
  int reach_;
  Ranks ranks_;
  std::unique_ptr<CoulombSolver> solver_;
  typename Chain<D>::Points field_;
};

}  // namespace treejet
