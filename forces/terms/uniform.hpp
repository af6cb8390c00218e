#pragma once
/// The two uniform forces along x:
///     electric field   f_el,i = q_i V_0 / h     ->   a_i = V q_i / m_i
///     gravity          f_g,i  = m_i g           ->   a_i = F_g
/// Source: paper, Sec. "Equations of motion".

#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class ElectricField final : public ForceTerm<D> {
 public:
  explicit ElectricField(double V) : V_(V) {}
  std::string_view name() const override { return "external field"; }
  void add(const Chain<D>& chain, Rows rows, Acceleration<D>& a) const override {
    const auto q = chain.point_charge.segment(rows.first, rows.size());
    const auto inverse_mass = chain.inverse_mass.segment(rows.first, rows.size());
    a.col(0).segment(rows.first, rows.size()) += V_ * q * inverse_mass;
  }
  Vec<D> on_held(const Chain<D>&) const override { return V_ * Vec<D>::UnitX(); }

 private:
  double V_;
};

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
