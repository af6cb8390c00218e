#pragma once
/// How the slope of a chain answers to a small change of its state, through the terms that are local and
/// fast.
///
/// Element i pulls its two beads together with tension T_i, a vector along it. With d = r_i - r_up and
/// w = v_i - v_up (up: the upper neighbour, for the youngest bead the nozzle, which does not answer)
///
///     delta T_i           = tension_by_d delta d + tension_by_stress delta sigma_i
///     delta (d sigma_i/dt) = rate_by_d . delta d + rate_by_w . delta w + rate_by_stress delta sigma_i
///     delta (dv_i/dt)      = (- delta T_i + delta T_{i-1}) / m_i + acceleration_by_v_i delta v_i
///     delta (dr_i/dt)      = delta v_i
///
/// so the Jacobian is block tridiagonal, (2 D + 1)-by-(2 D + 1) blocks. What couples a bead to its own
/// velocity only (drag) is the last block; without such a term there are none. Added columns are not solved
/// for. Scaled.

#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

template <int D>
struct ElementJacobian {
  Eigen::Matrix<double, D, D> tension_by_d = Eigen::Matrix<double, D, D>::Zero();
  Vec<D> tension_by_stress = Vec<D>::Zero();
  Vec<D> rate_by_d = Vec<D>::Zero(), rate_by_w = Vec<D>::Zero();
  double rate_by_stress = 0;
};

template <int D>
struct LocalJacobian {
  std::vector<ElementJacobian<D>> element;
  std::vector<Eigen::Matrix<double, D, D>> acceleration_by_v;  ///< a block a bead, or none
  Eigen::ArrayXd inverse_mass;

  /// The blocks by velocity, of n beads, for a term that adds to them.
  std::vector<Eigen::Matrix<double, D, D>>& by_velocity() {
    acceleration_by_v.resize(element.size(), Eigen::Matrix<double, D, D>::Zero());
    return acceleration_by_v;
  }
};

}  // namespace treejet
