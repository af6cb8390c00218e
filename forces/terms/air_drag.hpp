#pragma once
/// Drag and lift of the gas around the jet (core/jet/gas.hpp), which moves at u along x. With
/// w = v_i - u, w_t = w.t along an element, w_n = w - w_t t across it, a_e = sqrt(V_e / (pi l_e)):
///
///   drag of a cylinder    f_e = - l_e ( pi a_e rho c_f |w_t| w_t t_e  +  a_e rho C_n |w_n| w_n )
///
///     full            bead i bears half of f_i and half of f_{i-1}; the nozzle bears its half of the
///                     youngest
///     jetspin         bead i bears f_i, drag along the jet only
///     jetspin-1.20    the same, with |w_t| for w_t, and 1 cm for the l_i of the lift: neither is a property
///                     of air, but with both its authors' record of a jet in counter-flow is met
///
///   lift of a bend        f_i = - l_i rho w_t^2 pi ((a_i + a_{i-1}) / 2)^2 k c_i
///
/// k the curvature and c_i the unit vector to its centre: the air around a bend drives it farther out, as
/// surface tension (forces/terms/surface_tension.hpp) pulls it in. Both read the velocity of the bead alone.
/// JETSPIN's drag points to the nozzle whatever the sign of w_t and takes the nozzle's radius for that of a
/// drop; here it is odd in w. The group that 1.20 prints for the lift is one L_0 short. Source: JETSPIN 1.21,
/// `airdrag`; cross-flow drag of thin bodies in the sense of G. I. Taylor, Proc. R. Soc. A 214 (1952) 158.

#include "core/jet/gas.hpp"
#include "core/jet/parameters.hpp"
#include "forces/terms/section.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class AirDrag final : public ForceTerm<D> {
 public:
  AirDrag(const Gas& gas, const Section& section, DragModel model)
      : gas_(gas),
        section_(section),
        full_(model == DragModel::full),
        to_nozzle_(model == DragModel::jetspin_1_20) {}
  std::string_view name() const override { return full_ ? "air drag" : "air drag along the jet"; }
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override;
  void differentiate(const Chain<D>& c, LocalJacobian<D>& J) const override;

 private:
  using Block = Eigen::Matrix<double, D, D>;

  Vec<D> wind(const Chain<D>& c, int i) const;
  Vec<D> force(const Chain<D>& c, int element, const Vec<D>& w) const;
  Block force_by_velocity(const Chain<D>& c, int element, const Vec<D>& w) const;
  double radius(const Chain<D>& c, int element) const;

  Gas gas_;
  Section section_;
  bool full_, to_nozzle_;
};

class AirLift final : public ForceTerm<3> {
 public:
  /// `length` stands for that of every element; 0: each has its own.
  AirLift(const Gas& gas, const Section& section, double length = 0)
      : gas_(gas), section_(section), length_(length) {}
  std::string_view name() const override { return "air lift"; }
  void add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const override;
  void differentiate(const Chain<3>& c, LocalJacobian<3>& J) const override;

 private:
  Vec<3> over_squared_speed(const Chain<3>& c, int i) const;
  double speed_along(const Chain<3>& c, int i) const;

  Gas gas_;
  Section section_;
  double length_;
};

}  // namespace treejet
