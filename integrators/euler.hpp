#pragma once
/// Euler's scheme, order 1:   0 |
///                            --+--
///                              | 1

#include "integrators/stepper.hpp"

namespace treejet {

template <int D>
class Euler final : public Stepper<D> {
 public:
  int order() const override { return 1; }
  int evaluations() const override { return 0; }

  void step(Motion<D>&, const Jet<D>&, const Node<D>& from, double h, Table<D>& next) override {
    next = from.y + h * from.slope;
  }
};

}  // namespace treejet
