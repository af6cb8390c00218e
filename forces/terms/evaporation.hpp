#pragma once
/// Evaporation (core/jet/evaporation.hpp) in the equations of motion: the solvent of each element as a
/// column, and Maxwell's equation for a fluid that thickens, or that of the spring of a Kelvin-Voigt element,
///
///     dw/dt = rate of evaporation ,        dsigma/dt = G(c) r - sigma / theta(c) ,   G = mu / theta ,
///                                          dsigma/dt = G(c) r ,
///
/// whose dashpot thickens with mu(c) (forces/terms/viscous_tension.hpp). A spring that stiffens keeps the
/// stress it has.
///
/// Mass of a bead and volume of its element follow the solvent before any force is evaluated; the solvent
/// that leaves takes its momentum along, so that it exerts no force. The air rests; an element meets it at
/// the speed of its middle. Scaled by the fluid at the nozzle.

#include "core/jet/evaporation.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

/// The first of the added columns: the law below finds it there.
template <int D>
class SolventColumn final : public ColumnRate<D> {
 public:
  explicit SolventColumn(const Evaporation& evaporation) : evaporation_(evaporation) {}

  Column column() const override {
    return {.name = "solvent",
            .unit = "1",
            .at_birth = evaporation_.solvent_at_birth(),
            .small = evaporation_.polymer(),
            .volume = 1,
            .end = evaporation_.end()};
  }
  void amend(Chain<D>& c, int added, Rows rows) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const double left = evaporation_.remaining(c.column(added)[i]);
      c.volume[i] *= left;
      c.inverse_mass[i] /= left;
    }
  }
  void set(const Chain<D>& c, int added, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const double w = c.column(added)[i];
      Vec<D> through = (c.velocity(i) + c.velocity_above(i)) / 2;
      through[0] -= evaporation_.wind();
      const double volume = c.volume[i] / evaporation_.remaining(w);
      rate[i] = evaporation_.rate(w, 1 / c.inverse_length[i], through.norm(), volume);
    }
  }

 private:
  Evaporation evaporation_;
};

template <int D>
class DryingStress final : public StressLaw<D> {
 public:
  /// `relaxes`: Maxwell's; else the spring.
  DryingStress(const Evaporation& evaporation, bool relaxes) : evaporation_(evaporation), relaxes_(relaxes) {}
  std::string_view name() const override {
    return relaxes_ ? "Maxwell stress of a drying fluid" : "Kelvin-Voigt stress of a drying fluid";
  }
  bool extrapolates() const override { return false; }

  void set(const Chain<D>& c, Rows rows, State<D>& slope) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const Fluid fluid = fluid_of(c, i);
      slope(i, stress_column<D>) = fluid.modulus * c.strain_rate[i] - c.stress[i] * fluid.relaxation_rate;
    }
  }
  StressDerivative derivative(const Chain<D>& c, int element) const override {
    const Fluid fluid = fluid_of(c, element);
    StressDerivative d;
    d.by_strain_rate[0] = fluid.modulus;
    d.by_state(0, 0) = -fluid.relaxation_rate;
    return d;
  }

 private:
  struct Fluid {
    double modulus, relaxation_rate;
  };
  Fluid fluid_of(const Chain<D>& c, int element) const {
    const double concentration = evaporation_.concentration(c.column(0)[element]);
    const double relaxation = evaporation_.relaxation_ratio(concentration);
    return {evaporation_.viscosity_ratio(concentration) / relaxation, relaxes_ ? 1 / relaxation : 0};
  }

  Evaporation evaporation_;
  bool relaxes_;
};

}  // namespace treejet
