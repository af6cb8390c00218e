#include "forces/terms/fed_element.hpp"

namespace treejet {

template <int D>
typename FedElement<D>::Shares FedElement<D>::shares(const Chain<D>& c) const {
  const double m = 1 / c.inverse_mass[c.beads - 1], s = c.held_mass, inertia = m + s / 4;
  return {m / inertia, s / 2 / inertia};
}

template <int D>
void FedElement<D>::bind(const Chain<D>& c, const Vec<D>& of_held, State<D>& slope) const {
  const int n = c.beads;
  const Shares share = shares(c);
  const Vec<D> gain = renewal(c) * (c.velocity(n - 1) - c.nozzle_velocity);
  const Vec<D> bound =
      share.own * velocity<D>(slope, n - 1) + share.held * (of_held - (nozzle_.acceleration(c.t) + gain) / 2);
  slope.row(n - 1).template segment<D>(velocity_column<D>) = bound.transpose().array();
  slope(n - 1, stress_column<D>) -= renewal(c) * c.stress[n - 1];
  for (Eigen::Index k = 0; k < slope.added(); ++k) {
    const Eigen::Index column = own_columns<D> + k;
    slope(n - 1, column) -=
        renewal(c) * ((*c.state)(n - 1, column) - nozzle_.at_birth().at(static_cast<std::size_t>(k)));
  }
}

template <int D>
void FedElement<D>::bind(const Chain<D>& c, LocalJacobian<D>& J) const {
  const auto youngest = static_cast<std::size_t>(c.beads - 1);
  const Shares share = shares(c);
  auto& by_state = J.element[youngest].stress.by_state;
  by_state(0, 0) -= renewal(c);
  if (J.law_column) by_state(1, 1) -= renewal(c);
  J.inverse_mass[c.beads - 1] *= share.own;
  auto& by_velocity = J.by_velocity()[youngest];
  by_velocity *= share.own;
  by_velocity.diagonal().array() -= share.held * renewal(c) / 2;
}

template class FedElement<1>;
template class FedElement<3>;

}  // namespace treejet
