#pragma once
/// How the slope of a chain answers to a small change of its state, through the terms that are local and
/// fast.
///
/// Element i pulls its two beads together with tension T_i, a vector along it. Its own state z_i is the
/// stress and the column, if there is one, that the stress law keeps beside it: the first of the added ones.
/// With d = r_i - r_up and w = v_i - v_up (up: the upper neighbour, for the youngest bead the nozzle, which
/// does not answer)
///
///     delta (strain rate) = rate_by_d . delta d + rate_by_w . delta w
///     delta T_i           = tension_by_d delta d + tension_by_w delta w + tension_by_stress delta sigma_i
///     delta (dz_i/dt)     = by_strain_rate delta (strain rate) + by_state delta z_i
///     delta (dv_i/dt)     = (- delta T_i + delta T_{i-1}) / m_i + acceleration_by_v_i delta v_i
///     delta (dr_i/dt)     = delta v_i
///
/// so the Jacobian is block tridiagonal. What couples a bead to its own velocity only (drag) is the last
/// block; without such a term there are none. Other added columns are not solved for. Scaled.
///
/// Of a chain in subdomains the rows are those of `subdomain`; in that of a neighbour what depends on its
/// other neighbour is not right.

#include <vector>

#include "core/jet/subdomain_rows.hpp"

namespace treejet {

/// How the rates of stress and of the law's column, in this order, answer to the strain rate and to both.
struct StressDerivative {
  Eigen::Vector2d by_strain_rate = Eigen::Vector2d::Zero();
  Eigen::Matrix2d by_state = Eigen::Matrix2d::Zero();
};

template <int D>
struct ElementJacobian {
  Eigen::Matrix<double, D, D> tension_by_d = Eigen::Matrix<double, D, D>::Zero();
  Eigen::Matrix<double, D, D> tension_by_w = Eigen::Matrix<double, D, D>::Zero();
  Vec<D> tension_by_stress = Vec<D>::Zero();
  Vec<D> rate_by_d = Vec<D>::Zero(), rate_by_w = Vec<D>::Zero();
  StressDerivative stress;
};

template <int D>
struct LocalJacobian {
  std::vector<ElementJacobian<D>> element;
  std::vector<Eigen::Matrix<double, D, D>> acceleration_by_v;  ///< a block a bead, or none
  Eigen::ArrayXd inverse_mass;
  bool law_column = false;                      ///< the law keeps one
  const SubdomainRows<D>* subdomain = nullptr;  ///< null: the rows are the whole chain

  /// The blocks by velocity, of n beads, for a term that adds to them.
  std::vector<Eigen::Matrix<double, D, D>>& by_velocity() {
    acceleration_by_v.resize(element.size(), Eigen::Matrix<double, D, D>::Zero());
    return acceleration_by_v;
  }
};

}  // namespace treejet
