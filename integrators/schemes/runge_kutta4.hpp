#pragma once
/// The classical Runge-Kutta scheme, order 4:    0  |
///                                              1/2 | 1/2
///                                              1/2 |  0   1/2
///                                               1  |  0    0    1
///                                              ----+--------------------
///                                                  | 1/6  1/3  1/3  1/6
/// Source: paper, Sec. "Integration schemes". JETSPIN 1.00 uses other abscissae in 3-D, which makes it first
/// order.

#include "integrators/schemes/stepper.hpp"

namespace treejet {

template <int D>
class RungeKutta4 final : public Stepper<D> {
 public:
  int order() const override { return 4; }
  int evaluations() const override { return 3; }

  void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    const auto& k1 = from.slope;
    this->set(stage_, from.y + h / 2 * k1);
    f(jet, from.t + h / 2, stage_, k2_);
    this->set(stage_, from.y + h / 2 * k2_);
    f(jet, from.t + h / 2, stage_, k3_);
    this->set(stage_, from.y + h * k3_);
    f(jet, from.t + h, stage_, k4_);
    this->set(next, from.y + h / 6 * (k1 + 2 * k2_ + 2 * k3_ + k4_));
  }

 private:
  State<D> stage_, k2_, k3_, k4_;
};

}  // namespace treejet
