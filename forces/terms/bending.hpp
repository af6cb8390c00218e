#pragma once
/// Bending: the moment with which a round thread resists being bent, of the same stresses as its tension.
///
/// A fibre at xi a from the axis of a thread of curvature kappa is drawn out by xi a kappa more than the
/// axis. By Maxwell's equation, which is linear, its stress is sigma + xi sigma_b, and the moment M =
/// integral of xi a times that over the section,
///
///     d sigma_b/dt = G d(a kappa)/dt - sigma_b / tau ,      M = pi a^3 / 4 sigma_b ,
///     dM/dt = B / l (K' - 3/2 e K) - (3/2 e + 1 / tau) M ,      B = G pi a^4 / 4 ,   da/dt = - e a / 2 ,
///
/// e the strain rate. At bead i, between elements i-1 and i of length l_- and l_+, tangents t_- and t_+,
///
///     K = t_- - t_+ ,   kappa = K / l ,   l = (l_- + l_+) / 2 ,   e the mean by length, a^2 by volume and
///     length,
///
/// and M is a vector along K, across the thread. The time derivatives are those that who goes with the bead
/// sees: of both vectors Omega x (K, M) is taken away, Omega = t x dt/dt, t the mean tangent. A thread so is
/// never twisted, and spins about its axis as little as the fluid that the nozzle lets out. Slow against tau
/// M = mu pi a^4 / 4 times the rate of curvature (mu of extension: 3 eta I), fast against it B kappa.
///
/// The power of the moments is sum of M . dK/dt. K turns with the tangents, so that element e feels
///
///     F_e = (1 - t t') (M_{e+1} - M_e) / l_e ,      f_i = - F_i + F_{i-1} .
///
/// Forces sum to zero; their torques, which are sum of K x M, as far as M lies along K: always while it is
/// elastic, or bends in a plane. Else the thread would answer with a torque along its axis, which is left
/// out. No moment at both ends, nor, while the nozzle lets beads go, at the youngest bead: fresh fluid comes
/// in straight. Waves along a straight thread obey  s (s + 1 / tau) = - B k^4 / (rho pi a^2) , k the
/// wavenumber; on a chain k^2 is less by 1/12 (k l)^2 of itself. They are slower than waves of tension by a /
/// l. Valid for a kappa << 1. Neighbours' moments are state, so that a chain of any range of beads will do
/// that says which of its ends are those of the jet.
///
/// M is a column a component, of the beads (a new one, where an element is split, has what is interpolated),
/// in the unit of G a^3 (core/jet/columns.hpp): its error counts by what a curvature of 1 / (4 l_step) makes
/// at the nozzle. Scaled: B = F_ve a^4 / (4 a_0^2). Sources: Love, Mathematical Theory of Elasticity, ch. 18;
/// for viscous threads Ribe, Proc. R. Soc. A 460 (2004) 3223.

#include "forces/terms/section.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

/// What force and rate have in common. `first`: the place of M_x among the added columns.
class BendingMoment {
 public:
  struct Setting {
    double F_ve;
    Section section;
    int first;
    bool fresh_youngest;  ///< it has no moment
    double mass_unit;     ///< of 1 in files, g cm^2/s^2
  };
  explicit BendingMoment(const Setting& setting) : set_(setting) {}

  /// M of a bead; none at ends, and beyond them.
  Vec<3> at(const Chain<3>& c, int bead) const;
  /// dM/dt.
  Vec<3> rate(const Chain<3>& c, int bead) const;
  /// B / l K, what M is of a thread bent faster than it relaxes.
  Vec<3> elastic(const Chain<3>& c, int bead) const;

  const Setting& setting() const { return set_; }

 private:
  bool has_moment(const Chain<3>& c, int bead) const;
  bool bends(const Chain<3>& c, int bead) const;

  Setting set_;
};

class Bending final : public ForceTerm<3> {
 public:
  explicit Bending(const BendingMoment& moment) : moment_(moment) {}
  std::string_view name() const override { return "bending"; }
  void add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const override;

 private:
  Vec<3> force(const Chain<3>& c, int element) const;

  BendingMoment moment_;
};

/// A component of M.
class BendingColumn final : public ColumnRate<3> {
 public:
  BendingColumn(const BendingMoment& moment, int component) : moment_(moment), component_(component) {}
  Column column() const override;
  void set(const Chain<3>& c, int added, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const override;

 private:
  BendingMoment moment_;
  int component_;
};

}  // namespace treejet
