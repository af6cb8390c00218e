#pragma once
/// Elements that are drawn out as a test prescribes, to watch a stress law alone.

#include "validation/support/scenes.hpp"

namespace treejet {

/// Makes each bead follow r = r_0 exp(rate t): every element is then drawn out at the same rate.
template <int D>
struct HomogeneousExtension final : ForceTerm<D> {
  explicit HomogeneousExtension(double strain_rate) : rate(strain_rate) {}
  std::string_view name() const override { return "homogeneous extension"; }
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    a.middleRows(rows.first, rows.size()) += rate * rate * c.point.middleRows(rows.first, rows.size());
  }
  double rate;
};

/// The equations of motion of one straight element with this stress law and these forces.
template <class... Terms>
EquationsOfMotion<1> element_with(std::unique_ptr<StressLaw<1>> law, Terms... terms) {
  std::vector<std::unique_ptr<ForceTerm<1>>> local;
  (local.push_back(std::make_unique<Terms>(std::move(terms))), ...);
  const Nozzle<1> nozzle(plain_parameters(), law->columns());
  return EquationsOfMotion<1>(nozzle, std::move(law), std::move(local), nullptr, Threads{1});
}

/// A jet of one element as it leaves the nozzle, for that law.
inline Jet<1> one_element(const StressLaw<1>& law, double length, double speed, double stress = 0) {
  const Columns columns = law.columns();
  Jet<1> jet;
  jet.y = State<1>(0, own_columns<1> + static_cast<Eigen::Index>(columns.size()));
  Bead<1> bead = {Vec<1>(length), Vec<1>(speed), stress};
  for (const Column& column : columns) bead.added.push_back(column.at_birth);
  append(jet, bead);
  return jet;
}

/// One element after time t at a steady strain rate, from the state of `from` where it is given.
inline Jet<1> drawn(std::unique_ptr<StressLaw<1>> law, double rate, double t, const Jet<1>* from = nullptr,
                    double steps = 400) {
  Jet<1> jet = one_element(*law, 1, rate);
  if (from) {
    jet.y = from->y;
    jet.y(0, velocity_column<1>) = rate * jet.y(0, 0);
  }
  auto f = element_with(std::move(law), HomogeneousExtension<1>(rate));
  march_to<1>(t, t / steps, jet, f, plain_parameters(), Scheme::verner6);
  return jet;
}

inline double stress(const Jet<1>& jet) {
  return jet.y(0, stress_column<1>);
}

}  // namespace treejet
