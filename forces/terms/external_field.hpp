#pragma once
/// The field between nozzle and collector, q_i E(r, t) on a bead, in which the potential goes with time by a
/// factor w(t) (core/jet/waveform.hpp):
///
///     uniform   E = w V_0 / h along x, or any constant vector      ->  a_i = w V q_i / m_i
///     rotating  E = (E_x, E_y cos theta, E_z sin theta)
///     map       E = w times that of a file (core/jet/field_map.hpp)
///     needle    E = w times that of a hyperboloid of tip radius R at distance h from a grounded plane
///
/// Needle and plane: with z the distance from the plane, r_1 and r_2 those from the foci at z = +f and -f,
///
///     f = sqrt(h (h + R)) ,   eta = (r_2 - r_1) / (2 f) ,   eta_0 = sqrt(h / (h + R)) ,
///     phi = V_0 atanh(eta) / atanh(eta_0) ,   E = - V_0 / (atanh(eta_0) (1 - eta^2)) grad eta ,
///
/// which is V_0 f / (atanh(eta_0) h R) at the tip. Positive drives a bead of positive charge to the
/// collector. Sources: paper, Sec. "Equations of motion"; the needle: prolate spheroidal coordinates.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "core/base/error.hpp"
#include "core/jet/field_map.hpp"
#include "core/jet/waveform.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class ElectricField final : public ForceTerm<D> {
 public:
  /// The group V of each component.
  ElectricField(const std::array<double, 3>& V, const Waveform& wave) : V_(V), wave_(wave) {}
  explicit ElectricField(double V) : ElectricField({V, 0, 0}, Waveform()) {}
  std::string_view name() const override { return "external field"; }
  bool extrapolates() const override { return wave_.extrapolates(); }
  double smooth_from(double t) override { return wave_.smooth_from(t); }

  void add(const Chain<D>& chain, Rows rows, Acceleration<D>& a) const override {
    const auto q = chain.point_charge.segment(rows.first, rows.size());
    const auto inverse_mass = chain.inverse_mass.segment(rows.first, rows.size());
    const std::array<double, 3> turn = wave_.direction(chain.t);
    for (int k = 0; k < D; ++k)
      if (V_[std::size_t(k)] != 0)
        a.col(k).segment(rows.first, rows.size()) +=
            V_[std::size_t(k)] * turn[std::size_t(k)] * wave_(chain.t) * q * inverse_mass;
  }
  Vec<D> on_held(const Chain<D>& chain) const override {
    const std::array<double, 3> turn = wave_.direction(chain.t);
    Vec<D> push = Vec<D>::Zero();
    for (int k = 0; k < D; ++k) push[k] = V_[std::size_t(k)] * turn[std::size_t(k)] * wave_(chain.t);
    return push;
  }

 private:
  std::array<double, 3> V_;
  Waveform wave_;
};

/// The field of a needle and a plane over the mean one, V_0 / h. Lengths in any unit.
class NeedleField {
 public:
  NeedleField(double tip_radius, double distance)
      : distance_(distance),
        focus_(std::sqrt(distance * (distance + tip_radius))),
        end_(std::atanh(std::sqrt(distance / (distance + tip_radius)))) {}

  Vec<3> operator()(const Vec<3>& r) const {
    Vec<3> e_1 = r, e_2 = r;  // from the foci, along the needle's axis
    e_1[0] = r[0] - distance_ + focus_;
    e_2[0] = r[0] - distance_ - focus_;
    const double r_1 = e_1.norm(), r_2 = e_2.norm(), eta = (r_2 - r_1) / (2 * focus_);
    const Vec<3> gradient = (e_2 / r_2 - e_1 / r_1) / (2 * focus_);
    return -distance_ / (end_ * (1 - eta * eta)) * gradient;
  }

  /// phi / V_0.
  double potential(const Vec<3>& r) const {
    Vec<3> e_1 = r, e_2 = r;
    e_1[0] = r[0] - distance_ + focus_;
    e_2[0] = r[0] - distance_ - focus_;
    return std::atanh((e_2.norm() - e_1.norm()) / (2 * focus_)) / end_;
  }

 private:
  double distance_, focus_;
  double end_;  ///< atanh(eta_0)
};

/// A map in scaled lengths.
struct ScaledMap {
  std::shared_ptr<const FieldMap> map;
  double unit;  ///< of length, cm

  Vec<3> operator()(const Vec<3>& r) const { return map->field(unit * r); }
};

/// A field that is known at every place; `V`: acceleration of a charge over mass 1 where it is 1.
template <int D, class Field>
class FieldOfPlace : public ForceTerm<D> {
 public:
  FieldOfPlace(double V, Field field, const Waveform& wave) : V_(V), field_(std::move(field)), wave_(wave) {}
  bool extrapolates() const override { return wave_.extrapolates(); }
  double smooth_from(double t) override { return wave_.smooth_from(t); }

  void add(const Chain<D>& chain, Rows rows, Acceleration<D>& a) const override {
    const double V = V_ * wave_(chain.t);
    for (int i = rows.first; i < rows.last; ++i) {
      const double push = V * chain.point_charge[i] * chain.inverse_mass[i];
      a.row(i) += push * field_(place(chain, i)).template head<D>().transpose().array();
    }
  }
  Vec<D> on_held(const Chain<D>& chain) const override {
    return V_ * wave_(chain.t) * field_(place(chain, chain.beads)).template head<D>();
  }

 protected:
  static Vec<3> place(const Chain<D>& chain, int point) {
    Vec<3> r = Vec<3>::Zero();
    r.template head<D>() = chain.point.row(point).matrix().transpose();
    return r;
  }
  const Field& field() const { return field_; }

 private:
  double V_;
  Field field_;
  Waveform wave_;
};

template <int D>
class NeedlePlate final : public FieldOfPlace<D, NeedleField> {
 public:
  using FieldOfPlace<D, NeedleField>::FieldOfPlace;
  std::string_view name() const override { return "field of needle and plate"; }
};

/// A bead off the map stops the run: NumericalError names it and the box.
template <int D>
class MappedField final : public FieldOfPlace<D, ScaledMap> {
 public:
  using FieldOfPlace<D, ScaledMap>::FieldOfPlace;
  std::string_view name() const override { return "field of a map"; }

  void prepare(const Chain<D>& chain, Rows rows, Threads) override {
    for (int i = rows.first; i < rows.last; ++i) expect_inside(chain, i);
    if (chain.held_mass > 0) expect_inside(chain, chain.beads);
  }

 private:
  void expect_inside(const Chain<D>& chain, int point) const {
    const auto& [map, unit] = this->field();
    const Vec<3> r = unit * this->place(chain, point);
    if (map->contains(r)) return;
    throw NumericalError(
        fmt::format("at scaled time {}: bead {} (number {} since the start) is at {:.4g}, {:.4g}, {:.4g} cm, "
                    "off the {}: {}; likely cause: the map is too small for the jet, or not in m",
                    chain.t, point, chain.number(point), r[0], r[1], r[2], map->name(), map->box()));
  }
};

}  // namespace treejet
