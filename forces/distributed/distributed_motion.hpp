#pragma once
/// The equations of motion of a chain held in subdomains, one a rank (chain_decomposition.hpp).
///
/// The local terms see the own beads with one neighbour on either side, which the ranks next along the chain
/// send at each evaluation; the Coulomb field is that of CoulombSolver, the held bead and the nozzle
/// belonging to the subdomain that ends there. The slopes of the oldest and the youngest bead go from their
/// ranks to all, so that their copies stay the same bits. A scheme that solves for the local terms finds here
/// how the subdomains hang together (core/jet/subdomain_rows.hpp).

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "forces/distributed/chain_decomposition.hpp"
#include "forces/terms/equations_of_motion.hpp"

namespace treejet {

class DistributedMotion final : public FullMotion<3>, private SubdomainRows<3> {
 public:
  /// `local` has no Coulomb term; it and `subdomains` outlive this.
  DistributedMotion(EquationsOfMotion<3>& local, const ChainDecomposition& subdomains, Threads threads)
      : local_(local), subdomains_(subdomains), threads_(threads) {}

  /// Without it there are no charges.
  void add_coulomb(double Q, const CoulombRequest& request) {
    Q_ = Q;
    solver_.emplace(request, default_isa(), TreeRanks{.subdomains = subdomains_.ranks()});
  }

  /// What the next field is made from beside the points, of this rank and this cut. On other ranks the field
  /// is looked at anew.
  void visit_field(Archive& state) {
    if (solver_) state(*solver_);
  }

  /// Sets chain and field, too, which nobody else looks at.
  void be_continued() { continued_ = true; }

  void operator()(const Jet<3>& jet, double t, const State<3>& y, State<3>& slope) override;
  void differentiate(const Jet<3>& jet, double t, const State<3>& y, LocalJacobian<3>& J) override;
  const Chain<3>& chain() const override { return chain_; }
  const Chain<3>::Points& field() const override { return field_of_rows_; }
  std::pair<const Chain<3>*, Rows> own_elements() const override {
    return {&local_.chain(), {first_, first_ + subdomains_.own().size()}};
  }
  double Q() const override { return Q_; }
  double smooth_from(double t) override { return local_.smooth_from(t); }

  /// Null without charges.
  const FieldErrorReport* error() const { return solver_ ? &solver_->report().error : nullptr; }

 private:
  std::pair<Eigen::Index, Eigen::Index> own() const override {
    return {first_, first_ + subdomains_.own().size()};
  }
  State<3> with_neighbours(const State<3>& table) const override;
  void put_back(const State<3>& rows, State<3>& table) const override;
  int place() const override { return subdomains_.ranks().rank(); }
  std::vector<double> of_all(std::span<const double> own) const override {
    return subdomains_.ranks().of_all(own);
  }

  void extend(const Jet<3>& jet, const State<3>& y);
  /// What the older and the younger neighbour say of their row next to ours, nothing where there is none;
  /// they are told the same of ours.
  using RecordOfRow = std::function<std::vector<double>(int row)>;
  std::array<std::vector<double>, 2> of_neighbours(const RecordOfRow& record) const;
  void repel(Rows own, State<3>& slope);
  void bind_youngest(Rows own, State<3>& slope) const;
  void set_last_evaluation(const Jet<3>& jet, double t, const State<3>& y);

  EquationsOfMotion<3>& local_;
  const ChainDecomposition& subdomains_;
  Threads threads_;
  double Q_ = 0;
  std::optional<CoulombSolver> solver_;
  Jet<3> extended_;  ///< the own beads between their neighbours
  int first_ = 0;    ///< of the own ones there
  State<3> slope_;
  Chain<3>::Points field_;  ///< at the own points
  bool continued_ = false;
  Chain<3> chain_;  ///< of all rows
  Chain<3>::Points field_of_rows_;
};

}  // namespace treejet
