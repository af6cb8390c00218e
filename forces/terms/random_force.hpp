#pragma once
/// The two parts of noise (core/jet/noise.hpp) that are forces:
///
///     friction        a_i = - g v_i
///     random force    a_i = b_i / sqrt(Delta) xi(i, k)     for k Delta <= t < (k + 1) Delta ,
///
/// xi a vector of independent standard normal numbers, drawn for bead i and interval k alone: whoever
/// computes the row, in whatever order, gets the same. The force jumps on the clock, where steps end. As
/// Delta -> 0 the solution becomes that of white noise (Wong and Zakai, Ann. Math. Stat. 36 (1965) 1560); as
/// the noise does not depend on the state, that of Ito and of Stratonovich alike. Over n intervals the force
/// alone moves the velocity by a normal number of variance b^2 n Delta, exactly.

#include <cmath>
#include <numbers>

#include "core/base/philox.hpp"
#include "core/jet/noise.hpp"
#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class Friction final : public ForceTerm<D> {
 public:
  explicit Friction(double g) : g_(g) {}
  std::string_view name() const override { return "friction"; }
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    a.middleRows(rows.first, rows.size()) -=
        g_ * c.state->middleRows(rows.first, rows.size()).template middleCols<D>(velocity_column<D>);
  }
  void differentiate(const Chain<D>&, LocalJacobian<D>& J) const override {
    for (auto& block : J.by_velocity()) block.diagonal().array() -= g_;
  }

 private:
  double g_;
};

template <int D>
class RandomForce final : public ForceTerm<D> {
 public:
  explicit RandomForce(const Noise& noise) : noise_(noise) {}
  std::string_view name() const override { return "random force"; }
  bool extrapolates() const override { return false; }

  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override {
    const auto node = static_cast<std::uint64_t>(interval_);
    for (int i = rows.first; i < rows.last; ++i) {
      const double size = std::sqrt(noise_.squared_amplitude(c.inverse_mass[i]) / noise_.interval);
      for (int k = 0; k < D; k += 2) {
        const auto xi = normal_pair(noise_.seed, static_cast<std::uint32_t>(k), c.number(i), node);
        a(i, k) += size * xi[0];
        if (k + 1 < D) a(i, k + 1) += size * xi[1];
      }
    }
  }

  double smooth_from(double t) override {
    interval_ = std::floor(t / noise_.interval);
    if ((interval_ + 1) * noise_.interval <= t) ++interval_;  // where the quotient is rounded down
    return (interval_ + 1) * noise_.interval;
  }

 private:
  Noise noise_;
  double interval_ = 0;  ///< k
};

}  // namespace treejet
