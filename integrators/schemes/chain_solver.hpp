#pragma once
/// Solves (1 - s J) u = g for a table u, J the local Jacobian of a chain (core/jet/local_jacobian.hpp).
///
/// Position and stress of a bead answer to velocities only, so both are eliminated by hand. With
/// [u] = u_i - u_up, p = 1 / (1 - s rate_by_stress) and tau_i the tension's answer to the known part,
///
///     u_r = g_r + s u_v ,
///     u_sigma = p (g_sigma + s rate_by_d . [g_r]) + p s (s rate_by_d + rate_by_w) . [u_v] ,
///     E_i = s tension_by_d + tension_by_stress (p s (s rate_by_d + rate_by_w))' ,
///     (m_i - s m_i acceleration_by_v_i) u_v,i + s E_i [u_v]_i - s E_{i-1} [u_v]_{i-1}
///         = m_i g_v,i - s tau_i + s tau_{i-1} .
///
/// What is left is block tridiagonal with D-by-D blocks: a twelfth of the work of 7-by-7 ones for D = 3.

#include "core/jet/local_jacobian.hpp"
#include "integrators/schemes/block_tridiagonal.hpp"

namespace treejet {

template <int D>
class ChainSolver {
 public:
  /// Keeps J, which must stay as it is until the last `solve`.
  void factor(const LocalJacobian<D>& J, double s) {
    J_ = &J;
    s_ = s;
    const std::size_t n = J.element.size();
    velocities_.row.resize(n);
    p_.resize(n);
    stress_by_w_.resize(n);
    Block E_below = Block::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& e = J.element[i];
      p_[i] = 1 / (1 - s * e.rate_by_stress);
      stress_by_w_[i] = p_[i] * s * (s * e.rate_by_d + e.rate_by_w);
      const Block E = s * e.tension_by_d + e.tension_by_stress * stress_by_w_[i].transpose();
      const double per_mass = s * J.inverse_mass[static_cast<Eigen::Index>(i)];
      velocities_.row[i].below = -per_mass * E_below;
      velocities_.row[i].diagonal = Block::Identity() + per_mass * (E + E_below);
      if (!J.acceleration_by_v.empty()) velocities_.row[i].diagonal -= s * J.acceleration_by_v[i];
      velocities_.row[i].above = -per_mass * E;
      E_below = E;
    }
    velocities_.factor();
  }

  /// Turns g into u, after `factor`.
  void solve(State<D>& g) {
    const std::size_t n = J_->element.size();
    v_.resize(n);
    Vec<D> tau_below = Vec<D>::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto& e = J_->element[i];
      Vec<D> d = position<D>(g, row);
      if (i + 1 < n) d -= position<D>(g, row + 1);
      double& stress = g(row, stress_column<D>);
      stress = p_[i] * (stress + s_ * e.rate_by_d.dot(d));
      const Vec<D> tau = e.tension_by_d * d + e.tension_by_stress * stress;
      v_[i] = velocity<D>(g, row) + s_ * J_->inverse_mass[row] * (tau_below - tau);
      tau_below = tau;
    }
    velocities_.solve(v_);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      g(row, stress_column<D>) += stress_by_w_[i].dot(i + 1 < n ? Vec<D>(v_[i] - v_[i + 1]) : v_[i]);
      g.row(row).template head<D>() += s_ * v_[i].transpose().array();
      g.row(row).template segment<D>(D) = v_[i].transpose().array();
    }
  }

 private:
  using Block = Eigen::Matrix<double, D, D>;

  const LocalJacobian<D>* J_ = nullptr;
  double s_ = 0;
  BlockTridiagonal<D> velocities_;
  std::vector<double> p_;
  std::vector<Vec<D>> stress_by_w_, v_;
};

}  // namespace treejet
