#pragma once
/// The Coulomb field of a chain held in pieces, one a rank, to a stated error: for DistributedTreeField what
/// CoulombSolver is for TreeField.
///
///     DistributedSolver coulomb({.accuracy = 1e-5}, ranks);
///     coulomb.field(subdomain, rows, field, threads);     called by all ranks, each with its own subdomain
///
/// `accuracy` is the relative L2 error of the field over all pieces. It is measured, not assumed: at sampled
/// leaves of all pieces against exact sums, to which every rank adds what its own points do, with the same
/// allowances as in coulomb_solver.hpp; again when the number of points has changed by a twentieth or the
/// chain has been cut anew, and so often that it takes measuring_share (rebuild_policy.hpp) of the work. All
/// ranks learn the same figures and take the same decisions, none of them from a clock.
///
/// Below the crossover, or where no tree is as accurate, the sum is direct: every rank is then sent all
/// points. Left out: near fields in single precision, Barnes-Hut.
///
/// NumericalError, on all ranks, if two points are at one place or a coordinate is not finite.

#include <optional>

#include "forces/coulomb/distributed/tree_field_distributed.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"

namespace treejet {

class DistributedSample;

class DistributedSolver final : public FieldSolver<3> {
 public:
  /// InputError for an accuracy or a pinned value out of range.
  DistributedSolver(const CoulombRequest& request, const Ranks& ranks, Isa isa = default_isa());

  /// `rows` are all points of the subdomain.
  void field(const PointCharges<3>& subdomain, Rows rows, const FieldArrays<3>& field,
             Threads threads) override;

  /// Its interactions are those of this rank; its work is that of the rank with the most.
  const CoulombReport& report() const override { return report_; }
  void visit(Archive& state) override { state(report_, policy_, measured_piece_, pieces_); }

  const DistributedTreeField& pieces() const { return pieces_; }

 private:
  void arrange(const PointCharges<3>& piece, Threads threads);
  void choose(const PointCharges<3>& piece, int n, Threads threads);
  void choose_order_of_points(const PointCharges<3>& piece, int n, TreeShape& shape, Threads threads);
  void search(const PointCharges<3>& piece, TreeShape shape, Threads threads);
  std::optional<SampledError> find_opening(const DistributedSample& sample, Threads threads);
  bool keeps(const PointCharges<3>& piece, int n, Threads threads);
  double work();
  bool cut_anew(int n) const;

  CoulombRequest request_;
  Ranks ranks_;
  Isa isa_;
  DistributedTreeField pieces_;
  CoulombReport report_;
  RebuildPolicy policy_;
  int measured_piece_ = 0;  ///< points of this piece at the last measurement
};

}  // namespace treejet
