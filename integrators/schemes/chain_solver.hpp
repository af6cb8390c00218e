#pragma once
/// Solves (1 - s J) u = g for a table u, J the local Jacobian of a chain (core/jet/local_jacobian.hpp).
///
/// Position and state of an element answer to velocities only, so both are eliminated by hand. With [u] = u_i
/// - u_up, P = (1 - s by_state)^-1, q = s P by_strain_rate and tau_i the tension's answer to the known part,
///
///     u_r = g_r + s u_v ,
///     u_z = P (g_z + s by_strain_rate rate_by_d . [g_r]) + q (s rate_by_d + rate_by_w) . [u_v] ,
///     E_i = s tension_by_d + tension_by_w + tension_by_stress (q_sigma (s rate_by_d + rate_by_w))' ,
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
    eliminated_.resize(n);
    Block E_below = Block::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& e = J.element[i];
      Eliminated& z = eliminated_[i];
      z.P = (Eigen::Matrix2d::Identity() - s * e.stress.by_state).inverse();
      const Eigen::Vector2d q = s * z.P * e.stress.by_strain_rate;
      const Vec<D> rate_by_u = s * e.rate_by_d + e.rate_by_w;
      z.stress_by_u = q[0] * rate_by_u;
      z.column_by_u = q[1] * rate_by_u;
      const Block E = s * e.tension_by_d + e.tension_by_w + e.tension_by_stress * z.stress_by_u.transpose();
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
      const Eliminated& z = eliminated_[i];
      Vec<D> d = position<D>(g, row);
      if (i + 1 < n) d -= position<D>(g, row + 1);
      const Eigen::Vector2d known =
          z.P * (element_state(g, row) + s_ * e.rate_by_d.dot(d) * e.stress.by_strain_rate);
      set_element_state(g, row, known);
      const Vec<D> tau = e.tension_by_d * d + e.tension_by_stress * known[0];
      v_[i] = velocity<D>(g, row) + s_ * J_->inverse_mass[row] * (tau_below - tau);
      tau_below = tau;
    }
    velocities_.solve(v_);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Eliminated& z = eliminated_[i];
      const Vec<D> u = i + 1 < n ? Vec<D>(v_[i] - v_[i + 1]) : v_[i];
      const Eigen::Vector2d answer = {z.stress_by_u.dot(u), z.column_by_u.dot(u)};
      set_element_state(g, row, element_state(g, row) + answer);
      g.row(row).template head<D>() += s_ * v_[i].transpose().array();
      g.row(row).template segment<D>(D) = v_[i].transpose().array();
    }
  }

 private:
  using Block = Eigen::Matrix<double, D, D>;

  struct Eliminated {
    Eigen::Matrix2d P;
    Vec<D> stress_by_u, column_by_u;
  };

  Eigen::Vector2d element_state(const State<D>& g, Eigen::Index row) const {
    return {g(row, stress_column<D>), J_->law_column ? g(row, own_columns<D>) : 0.};
  }
  void set_element_state(State<D>& g, Eigen::Index row, const Eigen::Vector2d& z) const {
    g(row, stress_column<D>) = z[0];
    if (J_->law_column) g(row, own_columns<D>) = z[1];
  }

  const LocalJacobian<D>* J_ = nullptr;
  double s_ = 0;
  BlockTridiagonal<D> velocities_;
  std::vector<Eliminated> eliminated_;
  std::vector<Vec<D>> v_;
};

}  // namespace treejet
