/// The recipe "a scheme" of docs/recipes.md.

#include <catch2/catch.hpp>

#include <cmath>

#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// The midpoint scheme, order 2: one evaluation half a step ahead, and its slope for the whole step.
template <int D>
class Midpoint final : public Stepper<D> {
 public:
  int order() const override { return 2; }
  int evaluations() const override { return 1; }

  void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    stage_ = from.y + h / 2 * from.slope;
    f(jet, from.t + h / 2, stage_, slope_);
    next = from.y + h * slope_;
  }

 private:
  State<D> stage_, slope_;
};

/// A stress that relaxes as exp(-t): the error at t = 1 after so many steps.
double error(int steps) {
  auto f = equations<3>(plain_parameters());
  const auto jet = jet_of<3>({{Vec<3>(3, 0, 0), Vec<3>(0, 0, 0), 1}});
  Midpoint<3> scheme;
  SolutionPoint<3> now{0, jet.y, slope(f, jet)};
  for (int i = 0; i < steps; ++i) {
    State<3> next;
    scheme.step(f, jet, now, 1.0 / steps, next);
    now.t += 1.0 / steps;
    now.y = next;
    f(jet, now.t, now.y, now.slope);
  }
  return now.y(0, stress_column<3>) - std::exp(-1);
}

}  // namespace

TEST_CASE("The midpoint scheme has order 2") {
  // the next term of the error is smaller by about h: 2 % of the order at 50 steps
  CHECK(std::log2(error(50) / error(100)) == Approx(2).margin(0.03));
}
