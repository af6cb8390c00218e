#pragma once
/// Gravity, along x:   f_i = m_i g   ->   a_i = F_g
/// Source: paper, Sec. "Equations of motion".

#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class Gravity final : public ForceTerm<D> {
 public:
  explicit Gravity(double F_g) : F_g_(F_g) {}
  std::string_view name() const override { return "gravity"; }
  void add(const Chain<D>&, Rows rows, Acceleration<D>& a) const override {
    a.col(0).segment(rows.first, rows.size()) += F_g_;
  }
  Vec<D> on_held(const Chain<D>&) const override { return F_g_ * Vec<D>::UnitX(); }

 private:
  double F_g_;
};

}  // namespace treejet
