#pragma once
/// The equations of motion: the terms that a scene names, summed: the local ones, each of a bead and its
/// neighbours, and the Coulomb force, which couples all beads. The right-hand sides of multirate and of a jet
/// in subdomains stand on this one.
///
///     dr_i/dt = v_i ,    m_i dv_i/dt = sum of the force terms ,    d sigma_i/dt = constitutive equation .
///
/// A term that is left out is not here: no test, no array. Every row is computed by one thread, in the order
/// of the terms, so the bits of the result do not depend on the number of threads. Source: paper, Sec.
/// "Equations of motion", scaled form.

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/jet/nozzle.hpp"
#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/full_motion.hpp"
#include "forces/terms/term.hpp"
#include "parallel/threads.hpp"

namespace treejet {

template <int D>
class EquationsOfMotion final : public FullMotion<D> {
 public:
  EquationsOfMotion(Nozzle<D> nozzle, std::unique_ptr<StressLaw<D>> stress_law,
                    std::vector<std::unique_ptr<ForceTerm<D>>> local_terms,
                    std::unique_ptr<CoulombForce<D>> coulomb, Threads threads);

  void operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) override;

  void differentiate(const Jet<D>& jet, double t, const State<D>& y, LocalJacobian<D>& J) override;

  double smooth_from(double t) override {
    double until = std::numeric_limits<double>::infinity();
    for (auto& term : local_terms_) until = std::min(until, term->smooth_from(t));
    return until;
  }

  void visit(Archive& state) override {
    if (coulomb_) state(*coulomb_);
  }

  /// Everything but the Coulomb force, which couples all beads, for the slopes of `rows`; they must have been
  /// prepared for.
  void prepare(const Chain<D>& chain, Rows rows, Threads threads);
  void set_local(const Chain<D>& chain, Rows rows, State<D>& slope) const;

  /// Adds the rate of the next column that the scene adds to the state, behind that of the stress law.
  void add_column(std::unique_ptr<ColumnRate<D>> rate) { column_rates_.push_back(std::move(rate)); }

  /// All columns added to the state, in their order.
  Columns columns() const {
    Columns all = stress_law_->columns();
    for (const auto& rate : column_rates_) all.push_back(rate->column());
    return all;
  }

  /// The Coulomb force, null in a scene without charge, and the chain, both as the last evaluation left them.
  const CoulombForce<D>* coulomb() const { return coulomb_.get(); }
  const Chain<D>& chain() const override { return chain_; }
  const typename Chain<D>::Points& field() const override { return coulomb_->field(); }
  std::pair<const Chain<D>*, Rows> own_elements() const override { return {&chain_, {0, chain_.beads}}; }
  double Q() const override { return coulomb_ ? coulomb_->Q() : 0; }

  const Nozzle<D>& nozzle() const { return nozzle_; }
  const StressLaw<D>& stress_law() const { return *stress_law_; }
  const std::vector<std::unique_ptr<ForceTerm<D>>>& local_terms() const { return local_terms_; }

 private:
  void amend(Rows rows);

  Nozzle<D> nozzle_;
  std::unique_ptr<StressLaw<D>> stress_law_;
  int law_columns_;
  std::vector<std::unique_ptr<ForceTerm<D>>> local_terms_;
  std::vector<std::unique_ptr<ColumnRate<D>>> column_rates_;
  std::unique_ptr<CoulombForce<D>> coulomb_;
  Threads threads_;
  Chain<D> chain_;
};

/// "2 threads (1 below 128 beads)".
std::string threads_description(Threads threads);

}  // namespace treejet
