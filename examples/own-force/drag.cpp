/// Treejet with a force of one's own: the drag of air that a fan stirs, m dv/dt = - c (1 + sin w t) |v| v,
/// with the energy it takes from each bead as a column of the state and from all of them as an observable.

#include <cmath>
#include <cstdio>

#include "treejet/core/jet/scales.hpp"
#include "treejet/integrators/run/front_door.hpp"

using namespace treejet;

struct Drag final : ForceTerm<3> {
  Drag(double c, double w) : c(c), w(w) {}
  std::string_view name() const override { return "quadratic drag"; }

  Vec<3> force(const Chain<3>& chain, int i) const {
    const Vec<3> v = chain.velocity(i);
    return -c * (1 + std::sin(w * chain.t)) * v.norm() * v;
  }
  void add(const Chain<3>& chain, Rows rows, Acceleration<3>& a) const override {
    for (int i = rows.first; i < rows.last; ++i)
      a.row(i) += chain.inverse_mass[i] * force(chain, i).transpose().array();
  }

  double c, w;
};

struct EnergyLost final : ColumnRate<3> {
  EnergyLost(const Drag& drag, double unit) : drag(drag), unit(unit) {}
  Column column() const override { return {.name = "lost", .unit = "erg", .scale = unit}; }
  void set(const Chain<3>& chain, int, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const override {
    for (int i = rows.first; i < rows.last; ++i) rate[i] = -drag.force(chain, i).dot(chain.velocity(i));
  }

  Drag drag;
  double unit;  // of the energy
};

OwnTerms<3> terms(const Parameters& p) {
  const Scales s = scales(p);
  const Drag drag(2e-9 * s.length / s.mass, 1e4 * s.time);  // c = 2e-9 g/cm, w = 1e4 rad/s
  OwnTerms<3> own;
  own.forces.push_back(std::make_unique<Drag>(drag));
  own.columns.push_back(std::make_unique<EnergyLost>(drag, s.mass * s.velocity * s.velocity));
  return own;
}

int main(int argc, char** argv) {
  const auto fastest = [](const Jet<3>& jet) {
    return jet.y.middleCols<3>(3).matrix().rowwise().norm().maxCoeff();
  };
  return front_door(argc, argv, {"quadratic drag", terms, {{"fastest", "1", fastest}}});
}
