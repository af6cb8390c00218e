/// The recipe "a column of the state" of docs/recipes.md.

#include <catch2/catch.hpp>

#include <cmath>

#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// The solvent in a bead, which evaporates: dw/dt = - w / tau.
class Solvent final : public ColumnRate<3> {
 public:
  explicit Solvent(double tau) : tau_(tau) {}

  Column column() const override {
    return {.name = "solvent", .unit = "1", .scale = 1, .at_birth = 0.9, .small = 1e-3};
  }

  void set(const Chain<3>& chain, int added, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const override {
    rate.segment(rows.first, rows.size()) = -chain.column(added).segment(rows.first, rows.size()) / tau_;
  }

 private:
  double tau_;
};

}  // namespace

TEST_CASE("The solvent of a bead that moves freely evaporates exponentially") {
  const double tau = 0.5, t = 1;
  auto f = equations<3>(plain_parameters());
  f.add_column(std::make_unique<Solvent>(tau));
  Jet<3> jet = jet_of<3>({with_added<3>({Vec<3>(1, 0, 0), Vec<3>(2, 0, 0)}, 0.9)});
  march_to<3>(t, 0.005, jet, f, plain_parameters(), Scheme::rk4);
  // Runge-Kutta errs by (h / tau)^5 / 120 a step, 2e-11 in all
  CHECK(jet.y(0, own_columns<3>) == Approx(0.9 * std::exp(-t / tau)).epsilon(1e-9));
  CHECK(jet.y(0, 0) == Approx(1 + 2 * t).epsilon(1e-12));  // round-off: the column does not touch the motion
}
