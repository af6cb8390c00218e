#pragma once
/// The direct sum as a field solver: its rows are shared out among ranks and threads, or all pairs of few
/// points are worked out once by Newton's third law. Of points further apart than `reach` along the chain the
/// pair is left out. Nothing is measured, as nothing is approximated.

#include "forces/coulomb/solver/field_solver.hpp"
#include "parallel/share_rows.hpp"
#include "parallel/work_clock.hpp"

namespace treejet {

template <int D>
class DirectSum final : public FieldSolver<D> {
 public:
  explicit DirectSum(int reach, const Ranks& ranks = {}) : reach_(reach), ranks_(ranks) {}

  std::string_view name() const override { return "Coulomb sum over all pairs"; }

  void field(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field,
             Threads threads) override {
    const Working at(Work::evaluate, points.n >= points_worth_telling);
    const bool all_pairs = reach_ >= points.n - 1;
    if (all_pairs && points.n <= few_points) return coulomb_mutual<D>(points, field);
    share_rows(ranks_, threads, rows, direct_block, field, [&](Rows some) {
      if (all_pairs)
        coulomb_direct<D>(points, some, field);
      else
        coulomb_plain<D>(points, some, field, reach_);
    });
  }

  const CoulombReport& report() const override { return report_; }
  void visit(Archive&) override {}

 private:
  int reach_;
  Ranks ranks_;
  CoulombReport report_;
};

}  // namespace treejet
