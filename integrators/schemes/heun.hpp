#pragma once
/// Heun's scheme, order 2:    0 |
///                            1 |  1
///                            --+----------
///                              | 1/2  1/2
/// Source: paper, Sec. "Integration schemes".

#include "integrators/schemes/stepper.hpp"

namespace treejet {

template <int D>
class Heun final : public Stepper<D> {
 public:
  int order() const override { return 2; }
  int evaluations() const override { return 1; }

  void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    const auto& k1 = from.slope;
    this->set(stage_, from.y + h * k1);
    f(jet, from.t + h, stage_, k2_);
    this->set(next, from.y + h / 2 * (k1 + k2_));
  }

 private:
  State<D> stage_, k2_;
};

}  // namespace treejet
