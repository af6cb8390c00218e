#pragma once
/// Euler's scheme, order 1:   0 |
///                            --+--
///                              | 1

#include "integrators/schemes/stepper.hpp"

namespace treejet {

template <int D>
class Euler final : public Stepper<D> {
 public:
  int order() const override { return 1; }
  int evaluations() const override { return 0; }

  void step(RightHandSide<D>&, const Jet<D>&, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    this->set(next, from.y + h * from.slope);
  }
};

}  // namespace treejet
