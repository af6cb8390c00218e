#pragma once
/// What outputs have to know of a scene's fluid to show an element: the stress that is no state of it but
/// follows its strain rate, and the columns that change its volume. Without either an element's stress is
/// that of its row, and all of its volume is left.

#include "core/jet/columns.hpp"
#include "core/jet/evaporation.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/viscous_stress.hpp"

namespace treejet {

/// (1/l) dl/dt of element i.
template <int D>
double strain_rate(const Jet<D>& jet, const Nozzle<D>& nozzle, Eigen::Index i) {
  const bool youngest = i + 1 == jet.size();
  const Vec<D> upper = youngest ? nozzle.position(jet.t) : position<D>(jet.y, i + 1);
  const Vec<D> upper_velocity = youngest ? nozzle.velocity(jet.t) : velocity<D>(jet.y, i + 1);
  const Vec<D> d = position<D>(jet.y, i) - upper;
  const double l = d.norm();
  return (velocity<D>(jet.y, i) - upper_velocity).dot(d) / (l * l);
}

struct Material {
  ViscousStress viscous = {};
  Columns added = {};
  std::optional<Evaporation> drying = {};

  /// All of the stress of element i, scaled.
  template <int D>
  double stress(const Jet<D>& jet, const Nozzle<D>& nozzle, Eigen::Index i) const {
    const double state = jet.y(i, stress_column<D>);
    if (!viscous.acts()) return state;
    return state + viscosity_ratio<D>(jet.y, i) * viscous(strain_rate<D>(jet, nozzle, i));
  }

  /// mu / mu_0 and G / G_0 of element i.
  template <int D>
  double viscosity_ratio(const State<D>& y, Eigen::Index i) const {
    return drying ? drying->viscosity_ratio(concentration<D>(y, i)) : 1;
  }
  template <int D>
  double modulus_ratio(const State<D>& y, Eigen::Index i) const {
    return drying ? viscosity_ratio<D>(y, i) / drying->relaxation_ratio(concentration<D>(y, i)) : 1;
  }

  /// Volume of element i, and mass of its bead, over those at the nozzle.
  template <int D>
  double remaining(const State<D>& y, Eigen::Index i) const {
    double left = 1;
    for (std::size_t k = 0; k < added.size(); ++k) {
      const double value = y(i, own_columns<D> + static_cast<Eigen::Index>(k));
      left += added[k].volume * (value - added[k].at_birth);
    }
    return left;
  }

 private:
  template <int D>
  double concentration(const State<D>& y, Eigen::Index i) const {
    return drying->polymer() / remaining<D>(y, i);
  }
};

}  // namespace treejet
