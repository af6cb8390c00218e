#pragma once
/// Surface tension as an energy: the surface of the elements costs alpha per area,
///
///     U = sum 2 pi a_e l_e alpha ,      T_e = dU/dl = pi a_e alpha      (a_e^2 l_e conserved),
///
/// a tension along each element. It acts in a straight jet as well, and on a bend of curvature k with
/// k pi a alpha per length; the paper's force (surface_tension.hpp) is k pi a^2 alpha per bead, which misses
/// the factor l/a. Short varicose waves are without the cut-off that the curvature along the jet would give
/// them: the tension falls as an element lengthens. Scaled. Source: Rayleigh, by the derivative above.

#include "forces/terms/section.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class SurfaceEnergy final : public ForceTerm<D> {
 public:
  /// alpha: such that an element of radius a pulls with pi alpha a, scaled.
  SurfaceEnergy(double alpha, Section section) : alpha_(alpha), section_(section) {}
  std::string_view name() const override { return "surface tension as an energy"; }
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override;
  void differentiate(const Chain<D>& c, LocalJacobian<D>& J) const override;

  /// U.
  double energy(const Chain<D>& c) const;

 private:
  double alpha_;
  Section section_;
};

}  // namespace treejet
