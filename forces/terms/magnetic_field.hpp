#pragma once
/// The magnetic force on the beads, q_i v_i x B / c (CGS), in a field that is the same everywhere and always:
///
///     a_i = q_i / m_i  v_i x M ,      M = q B tau / (m c)    (core/jet/scales.hpp).
///
/// It does no work; alone it leads a bead round a helix along B, at |M| q_i / m_i radians a time. It is weak:
/// a bead of the paper's PVP in one tesla turns by 0.0175 rad/s, and is on its way for hundredths of a
/// second. JETSPIN 1.21 has it in its source, where no release lets a deck reach it.
///
/// A held bead moves at the mean of nozzle and youngest bead (core/jet/feed_by_flow.hpp).

#include <Eigen/Geometry>
#include <array>

#include "forces/terms/term.hpp"

namespace treejet {

class MagneticField final : public ForceTerm<3> {
 public:
  explicit MagneticField(const std::array<double, 3>& M) : M_(M[0], M[1], M[2]) {
    // v x M = turn v
    turn_ << 0, M_[2], -M_[1], -M_[2], 0, M_[0], M_[1], -M_[0], 0;
  }
  std::string_view name() const override { return "magnetic field"; }

  void add(const Chain<3>& c, Rows rows, Acceleration<3>& a) const override {
    for (int i = rows.first; i < rows.last; ++i)
      a.row(i) += (charge_over_mass(c, i) * c.velocity(i).cross(M_)).transpose().array();
  }
  void differentiate(const Chain<3>& c, LocalJacobian<3>& J) const override {
    auto& by_velocity = J.by_velocity();
    for (int i = 0; i < c.beads; ++i) by_velocity[std::size_t(i)] += charge_over_mass(c, i) * turn_;
  }
  Vec<3> on_held(const Chain<3>& c) const override {
    return ((c.velocity(c.beads - 1) + c.nozzle_velocity) / 2).cross(M_);
  }

 private:
  static double charge_over_mass(const Chain<3>& c, int i) { return c.point_charge[i] * c.inverse_mass[i]; }

  Vec<3> M_;
  Eigen::Matrix3d turn_;
};

}  // namespace treejet
