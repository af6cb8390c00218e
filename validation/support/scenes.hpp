#pragma once
/// Small scenes put together by hand: a jet given bead by bead, moved by the terms that a test names.

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "forces/terms/constitutive.hpp"
#include "forces/terms/equations_of_motion.hpp"
#include "integrators/run/integration.hpp"

namespace treejet {

/// A nozzle at rest with elements of scaled length 1, the collector far away: L_0 = l_step without charge.
inline Parameters plain_parameters() {
  Parameters p;
  p.points = 1;
  p.initial_length = 1;
  p.nozzle_cross = 0.1;
  p.density_mass = p.viscosity = p.elastic_modulus = 1;
  p.collector_distance = 1000;
  return p;
}

inline Bead<1> bead_at(double x, double v = 0, double stress = 0) {
  return Bead<1>(Vec<1>(x), Vec<1>(v), stress);
}

template <int D>
Jet<D> jet_of(const std::vector<Bead<D>>& beads) {
  Jet<D> jet;
  if (!beads.empty()) jet.y.resize(0, own_columns<D> + Eigen::Index(beads[0].added.size()));
  for (const auto& bead : beads) append<D>(jet, bead);
  return jet;
}

/// A bead of one column more, which has this value.
template <int D>
Bead<D> with_added(Bead<D> bead, double value) {
  bead.added = {value};
  return bead;
}

/// As the equations of motion see the jet at its time.
template <int D>
Chain<D> chain_of(const Jet<D>& jet, const Nozzle<D>& nozzle) {
  Chain<D> chain;
  const std::pair<Eigen::Index, Eigen::Index> all{0, jet.size()};
  set_boundary<D>(chain, jet, nozzle, jet.t, jet.y);
  set_points<D>(chain, jet, jet.y, all);
  set_elements<D>(chain, jet, jet.y, all);
  return chain;
}

/// The equations of motion with exactly these force terms.
template <int D, class... Terms>
EquationsOfMotion<D> equations(const Parameters& p, Terms... terms) {
  std::vector<std::unique_ptr<ForceTerm<D>>> local;
  std::unique_ptr<CoulombForce<D>> coulomb;
  [[maybe_unused]] const auto take = [&]<class Term>(Term& term) {
    if constexpr (std::is_same_v<Term, CoulombForce<D>>)
      coulomb = std::make_unique<Term>(std::move(term));
    else
      local.push_back(std::make_unique<Term>(std::move(term)));
  };
  (take(terms), ...);
  return EquationsOfMotion<D>(Nozzle<D>(p), std::make_unique<Maxwell<D>>(), std::move(local),
                              std::move(coulomb), Threads{1});
}

template <int D>
State<D> slope(EquationsOfMotion<D>& f, const Jet<D>& jet) {
  State<D> dy;
  f(jet, jet.t, jet.y, dy);
  return dy;
}

/// Marches a jet of such a scene to scaled time `end` in scaled steps of dt.
template <int D>
void march_to(double end, double dt, Jet<D>& jet, EquationsOfMotion<D>& f, const Parameters& p,
              Scheme scheme) {
  Parameters stepped = p;
  stepped.integrator = scheme;
  stepped.timestep = dt * scales(p).time;
  const Nozzle<D> nozzle(p);
  const Collector collector(p);
  Integration<D>(stepped, {jet, f, nozzle, collector, undivided<D>, f.columns()}).march.to(end);
}

}  // namespace treejet
