#pragma once
/// The viscoelastic force: each element pulls its two beads together with tension pi a_i^2 sigma_i,
///
///     f_i = - pi a_i^2 sigma_i t_i + pi a_{i-1}^2 sigma_{i-1} t_{i-1} ,
///
/// and with the volume of an element conserved, pi a_i^2 = pi a_0^2 l_step V_i / l_i (V_i = 1 for an initial
/// bead),
///
///     a_i = (L_step F_ve / m_i) ( - V_i sigma_i / l_i t_i + V_{i-1} sigma_{i-1} / l_{i-1} t_{i-1} ) .
///
/// Element i joins bead i and its upper neighbour (core/jet/chain.hpp); the oldest bead has no element below
/// it. Source: paper, Sec. "Equations of motion" (which labels the elements i and i+1) and the scaled Newton
/// equation.

#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class Viscoelastic final : public ForceTerm<D> {
 public:
  Viscoelastic(double L_step, double F_ve) : coefficient_(L_step * F_ve) {}
  std::string_view name() const override { return "viscoelastic force"; }
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override;
  void differentiate(const Chain<D>& c, LocalJacobian<D>& J) const override;

 private:
  double coefficient_;
};

}  // namespace treejet
