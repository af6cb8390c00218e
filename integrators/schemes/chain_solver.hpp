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
/// What is left is block tridiagonal with D-by-D blocks: a twelfth of the work of 7-by-7 ones for D = 3. Of a
/// chain in subdomains each process eliminates what is its own, and all solve for the velocities together.

#include <optional>

#include "core/jet/local_jacobian.hpp"
#include "integrators/schemes/block_tridiagonal.hpp"
#include "integrators/schemes/cut_block_tridiagonal.hpp"

namespace treejet {

template <int D>
class ChainSolver {
 public:
  /// Keeps J, which must stay as it is until the last `solve`.
  void factor(const LocalJacobian<D>& J, double s) {
    J_ = &J;
    s_ = s;
    const std::size_t n = J.element.size();
    own_ = J.subdomain ? J.subdomain->own() : std::pair(Eigen::Index{0}, static_cast<Eigen::Index>(n));
    velocities_.row.resize(static_cast<std::size_t>(own_.second - own_.first));
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
      if (is_own(i)) set_row(i, s * J.inverse_mass[static_cast<Eigen::Index>(i)], E_below, E);
      E_below = E;
    }
    cut_.reset();
    if (J.subdomain) {
      cut_.emplace(J.subdomain->place(), [whole = J.subdomain](auto own) { return whole->of_all(own); });
      cut_->factor(velocities_);
    } else {
      velocities_.factor();
    }
  }

  /// Turns g into u, after `factor`.
  void solve(State<D>& g) {
    if (!J_->subdomain) return solve_rows(g);
    State<D> rows = J_->subdomain->with_neighbours(g);
    solve_rows(rows);
    J_->subdomain->put_back(rows, g);
  }

 private:
  using Block = Eigen::Matrix<double, D, D>;

  struct Eliminated {
    Eigen::Matrix2d P;
    Vec<D> stress_by_u, column_by_u;
  };

  bool is_own(std::size_t i) const { return Eigen::Index(i) >= own_.first && Eigen::Index(i) < own_.second; }

  void set_row(std::size_t i, double per_mass, const Block& E_below, const Block& E) {
    auto& row = velocities_.row[i - static_cast<std::size_t>(own_.first)];
    row.below = -per_mass * E_below;
    row.diagonal = Block::Identity() + per_mass * (E + E_below);
    if (!J_->acceleration_by_v.empty()) row.diagonal -= s_ * J_->acceleration_by_v[i];
    row.above = -per_mass * E;
  }

  void solve_rows(State<D>& g) {
    eliminate(g);
    if (cut_) {
      cut_->solve(v_);
    } else {
      velocities_.solve(v_);
      v_.push_back(Vec<D>::Zero());
    }
    for (Eigen::Index row = own_.first; row < own_.second; ++row) {
      const auto k = static_cast<std::size_t>(row - own_.first);
      const Eliminated& z = eliminated_[static_cast<std::size_t>(row)];
      const Vec<D> u = v_[k] - v_[k + 1];
      const Eigen::Vector2d answer = {z.stress_by_u.dot(u), z.column_by_u.dot(u)};
      set_element_state(g, row, element_state(g, row) + answer);
      g.row(row).template head<D>() += s_ * v_[k].transpose().array();
      g.row(row).template segment<D>(D) = v_[k].transpose().array();
    }
  }

  /// Leaves the known part of the elements' states in g, and what is known of the own velocities in v_.
  void eliminate(State<D>& g) {
    const std::size_t n = J_->element.size();
    v_.clear();
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
      if (is_own(i)) v_.push_back(velocity<D>(g, row) + s_ * J_->inverse_mass[row] * (tau_below - tau));
      tau_below = tau;
    }
  }

  Eigen::Vector2d element_state(const State<D>& g, Eigen::Index row) const {
    return {g(row, stress_column<D>), J_->law_column ? g(row, own_columns<D>) : 0.};
  }
  void set_element_state(State<D>& g, Eigen::Index row, const Eigen::Vector2d& z) const {
    g(row, stress_column<D>) = z[0];
    if (J_->law_column) g(row, own_columns<D>) = z[1];
  }

  const LocalJacobian<D>* J_ = nullptr;
  double s_ = 0;
  std::pair<Eigen::Index, Eigen::Index> own_;  ///< rows that are solved for here
  BlockTridiagonal<D> velocities_;             ///< of these
  std::optional<CutBlockTridiagonal<D>> cut_;  ///< of a chain in subdomains
  std::vector<Eliminated> eliminated_;
  std::vector<Vec<D>> v_;
};

}  // namespace treejet
