#pragma once
/// The tension of the stress that follows the strain rate of an element at once
/// (core/jet/viscous_stress.hpp): a solvent's, a Kelvin-Voigt dashpot's, that of a power-law fluid,
///
///     f_i = - pi a_i^2 sigma(r_i) t_i + pi a_{i-1}^2 sigma(r_{i-1}) t_{i-1} ,
///
/// thicker by mu(c) / mu_0 where the fluid dries (core/jet/evaporation.hpp), which stands beside the
/// viscoelastic force (forces/terms/viscoelastic.hpp) and is scaled as that is. An explicit scheme is stable
/// up to steps of about rho l^2 / (2 mu).

#include "core/jet/evaporation.hpp"
#include "core/jet/viscous_stress.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class ViscousTension final : public ForceTerm<D> {
 public:
  /// `drying`: of a fluid whose solvent is the first of the added columns.
  ViscousTension(double L_step, double F_ve, const ViscousStress& stress,
                 const std::optional<Evaporation>& drying = {})
      : coefficient_(L_step * F_ve), stress_(stress), drying_(drying) {}
  std::string_view name() const override { return "viscous tension"; }
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override;
  void differentiate(const Chain<D>& c, LocalJacobian<D>& J) const override;

  /// It damps faster than the intervals at which multirate looks at slow beads.
  bool extrapolates() const override { return false; }

 private:
  Vec<D> tension(const Chain<D>& c, int element) const;
  /// The factor of the tension, without the stress.
  double coefficient(const Chain<D>& c, int element) const;

  double coefficient_;
  ViscousStress stress_;
  std::optional<Evaporation> drying_;
};

}  // namespace treejet
