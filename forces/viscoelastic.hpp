#pragma once
/// The viscoelastic force: each element pulls its two beads together with tension pi a_i^2 sigma_i,
///
///     f_i = - pi a_i^2 sigma_i t_i + pi a_{i-1}^2 sigma_{i-1} t_{i-1} ,
///
/// and with the volume of an element conserved, pi a_i^2 = pi a_0^2 l_step / l_i,
///
///     a_i = (L_step F_ve / m_i) ( - sigma_i / l_i t_i + sigma_{i-1} / l_{i-1} t_{i-1} ) .
///
/// Element i joins bead i and its upper neighbour (core/chain.hpp); the oldest bead has no element below it.
/// Source: paper, Sec. "Equations of motion" (which labels the elements i and i+1) and the scaled Newton
/// equation.

#include "forces/term.hpp"

namespace treejet {

template <int D>
class Viscoelastic final : public ForceTerm<D> {
 public:
  Viscoelastic(double L_step, double F_ve) : coefficient_(L_step * F_ve) {}
  std::string_view name() const override { return "viscoelastic force"; }

  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    const int above = rows.first,
              below = above > 0 ? above - 1 : 0;    // first element on either side of a bead
    const int pulled_down = rows.last - 1 - below;  // beads of `rows` that have an element below
    const auto tension = [&](int first, int count) {
      return coefficient_ * c.stress.segment(first, count) * c.inverse_length.segment(first, count);
    };
    for (int k = 0; k < D; ++k) {
      const auto t = c.tangent.col(k);
      a.col(k).segment(above, rows.size()) -= tension(above, rows.size()) * t.segment(above, rows.size()) *
                                              c.inverse_mass.segment(above, rows.size());
      a.col(k).segment(below + 1, pulled_down) += tension(below, pulled_down) *
                                                  t.segment(below, pulled_down) *
                                                  c.inverse_mass.segment(below + 1, pulled_down);
    }
  }

  /// T = C sigma d / l^2:   dT/dd = C sigma / l^2 (1 - 2 t t') ,   dT/dsigma = C t / l .
  void differentiate(const Chain<D>& c, LocalJacobian<D>& J) const override {
    for (int i = 0; i < c.beads; ++i) {
      const Vec<D> t = c.tangent.row(i).matrix().transpose();
      const double stiffness = coefficient_ * c.stress[i] * c.inverse_length[i] * c.inverse_length[i];
      J.element[i].tension_by_d +=
          stiffness * (Eigen::Matrix<double, D, D>::Identity() - 2 * t * t.transpose());
      J.element[i].tension_by_stress += coefficient_ * c.inverse_length[i] * t;
    }
  }

 private:
  double coefficient_;
};

}  // namespace treejet
