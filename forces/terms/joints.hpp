#pragma once
/// Where elements of unequal length meet: what a chain of point charges then lacks, or has too much of, in
/// its repulsion over a cut through an element, as a tension that balances it.
///
/// A straight uniform line at rest is in balance at each point. A chain of points with the bond of
/// slender_self_field.hpp is so too if its elements are alike; at a joint of 1 : 2 the beads next to it are
/// pushed by half of lambda^2. With x the volume along the chain, q_i half of the two elements at bead i, V
/// the volume of the element and D = K V,
///
///     c_e = sum_{i <= e < j} q_i q_j / (x_j - x_i)^2 w((x_j - x_i) / D)  -  sum_{k = 1}^{K} w(k / K) / k ,
///
/// w(u) = (1 - u^2)^4, is what the repulsion over the cut differs from that of equal elements, in lambda^2.
/// It depends on the volumes only, so it is frozen into the fluid: the tension lambda^2 c_e comes of the
/// energy
/// - Q_e^2 / l_e c_e. The virial of a chain in balance vanishes, so that with the forces the energy of the
/// joint is right, too: on a curve the force summed over a smooth weight is of second order in the spacing,
/// whatever the joints. The force on a single bead beside one is off by lambda^2 times the turn of the
/// element.
///
/// Error: O(1 / K^4). Beyond the ends the chain is thought to go on as it ends. At 1 : 2 c is -0.13 in the
/// last large element, 0.41 and 0.09 in the first small ones. Source: derived here.

#include <Eigen/Core>

namespace treejet {

/// c of the elements of these volumes.
Eigen::ArrayXd tension_of_joints(const Eigen::ArrayXd& volume);

}  // namespace treejet
