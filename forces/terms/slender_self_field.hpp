#pragma once
/// What a chain of point charges leaves out of the field of a thin tube: with it the force on a bend no
/// longer depends on the spacing of the beads.
///
/// Within L of a point a tube of radius a and line charge lambda, charged on its surface, makes the potential
/// 2 lambda ln(2 L / a), beads at spacing l make 2 lambda (ln(L / l) + gamma). The energy of the difference,
/// of an element e of charge Q_e, and the tension that follows from it, as charge and volume (a^2 l) are
/// frozen into the fluid, are
///
///     U_e = Q_e^2 / l_e g ,    g = ln(2 l_e / a_e) - gamma ,      T_e = dU_e/dl = Q_e^2 / l_e^2 (3/2 - g) ;
///
/// of 3/2, 1/2 is the electric pressure. The element pulls its beads together as in viscoelastic.hpp, so that
/// momentum is kept, and energy while no bead is held. Without it: 1 - g.
///
///   - Charge: Q_e = V_e sqrt(c_i c_up), c the charge over mass of its two beads, so that a free end may be a
///     bead of half a cell. A whole one stands for a tube that reaches half an element farther.
///   - Elements below l = 2 a: g -> ln(1 + e^(8 g)) / 8, 3/2 -> 3/2 / (1 + e^(-8 g)). U stays positive and
///   finite.
///   - While a bead is held with charge s, the youngest element, of length d, has
///     (1 - s) T(d) + s T(d - l_step).
///   - An element that dries (core/jet/evaporation.hpp) keeps its charge: with nu left of its volume, and of
///     the mass of its beads, Q_e = V_e sqrt(c_i c_up nu_up / nu_e), where the nozzle's nu is 1.
///   - Where elements of unequal volume meet, which refinement brings about: g is less, and the 3/2 - g of
///     the tension more, by c_e of joints.hpp, of the volumes at the nozzle, to which charges are in
///     proportion.
///
/// Errors: O(a^2 / R^2) at distance R; second order in smooth spacings. A form exact at any l/a on a straight
/// line softens the repulsion of some eight neighbours by a and has a g that is greater by 0.6 (a / l)^2; it
/// is not taken, for neither the stiff scheme nor a chain in subdomains could treat it as local. Scaled.
/// Sources: slender-body theory; the electric pressure as in Hohman, Shin, Rutledge and Brenner, Phys. Fluids
/// 13 (2001) 2201.

#include "core/jet/evaporation.hpp"
#include "forces/terms/section.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class SlenderSelfField final : public ForceTerm<D> {
 public:
  /// Q: the Coulomb term's group. `uneven`: elements of unequal volume may meet; then the chain knows the
  /// volumes of the whole jet. `drying`: the first added column is the solvent.
  SlenderSelfField(double Q, Section section, bool uneven = false,
                   const std::optional<Evaporation>& drying = {})
      : Q_(Q), section_(section), uneven_(uneven), drying_(drying) {}
  std::string_view name() const override { return "slender self-field"; }
  void prepare(const Chain<D>& c, Rows rows, Threads threads) override;
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override;
  void differentiate(const Chain<D>& c, LocalJacobian<D>& J) const override;

  /// Sum of U_e. Meaningless while a bead is held: its charge is a function of time.
  double energy(const Chain<D>& c) const;

 private:
  double left(const Chain<D>& c, int element) const;
  double charges(const Chain<D>& c, int element) const;
  double joint(const Chain<D>& c, int element) const;
  double tension_of_youngest(const Chain<D>& c) const;

  double Q_;
  Section section_;
  bool uneven_;
  std::optional<Evaporation> drying_;
  Census census_;
  Eigen::ArrayXd volume_, joints_;  ///< of all elements of the jet, and what follows
};

}  // namespace treejet
