#include "forces/scene/initial_jet.hpp"

#include <numeric>

#include "core/jet/scales.hpp"

namespace treejet {

namespace {

/// A jet that ends for good at its free end has half a cell there. With insertion the end is one of many: a
/// whole bead, as the next one will be.
bool ends_in_half_a_cell(const Parameters& p) {
  return p.self_field == SelfField::slender && !p.inserting;
}

}  // namespace

template <int D>
Jet<D> initial_jet(const Parameters& p, const std::vector<int>& beads, const Columns& added) {
  const Scales s = scales(p);
  const auto n = static_cast<Eigen::Index>(beads.size());
  Vec<D> r = Vec<D>::Zero(), v = Vec<D>::Zero();
  v[0] = inlet_velocity(p) / s.velocity;
  Jet<D> jet;
  jet.y.resize(n, own_columns<D> + static_cast<Eigen::Index>(added.size()));
  jet.mass.setOnes(n);
  jet.charge.setOnes(n);
  jet.volume.setOnes(n);
  jet.held = p.inserting && p.feed == Feed::flow;  // an empty bead
  for (Eigen::Index i = 0; i < n; ++i) {
    r[0] = (initial_elements(p) - beads[static_cast<std::size_t>(i)]) * s.l_step / s.length;
    if (beads[static_cast<std::size_t>(i)] == 0 && ends_in_half_a_cell(p)) jet.mass[i] = jet.charge[i] = 0.5;
    jet.y.row(i).template head<own_columns<D>>() << r.transpose().array(), v.transpose().array(),
        p.nozzle_stress / s.stress;
  }
  for (std::size_t k = 0; k < added.size(); ++k)
    jet.y.col(own_columns<D> + static_cast<Eigen::Index>(k)).setConstant(added[k].at_birth);
  return jet;
}

std::vector<int> initial_beads(const Parameters& p) {
  std::vector<int> beads(static_cast<std::size_t>(initial_elements(p)));
  std::iota(beads.begin(), beads.end(), 0);
  return beads;
}

template Jet<1> initial_jet<1>(const Parameters&, const std::vector<int>&, const Columns&);
template Jet<3> initial_jet<3>(const Parameters&, const std::vector<int>&, const Columns&);

}  // namespace treejet
