#pragma once
/// The paper's constitutive equation of an element, scaled (stress by G, time by mu / G), and JETSPIN's
/// options:
///
///     Maxwell             d sigma/dt = r - sigma
///     Herschel-Bulkley    d sigma/dt = ( sigma_Y + K e^n ) r / e - sigma ,      e = sqrt(r^2 + r_0^2)
///
/// with r = (1/l) dl/dt. JETSPIN has e = r, so that an element that shortens gets NaN (n not an integer) or
/// stress that grows, and one at rest yields. With e = |r| the first would be right, but an element that
/// comes to rest swings ever faster through r = 0, and no error estimate sees the jump of its stress rate
/// there: e rounds it over the strain rate r_0. Where an element stretches at r >> r_0 all agree, to r_0^2 /
/// (2 r^2) of the yield stress. Source: paper, constitutive equation; the rounding: Bercovier and Engelman,
/// J. Comput. Phys. 36 (1980) 313.
///
/// Other fluids stand in forces/terms/laws.

#include <cmath>

#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class Maxwell final : public StressLaw<D> {
 public:
  std::string_view name() const override { return "Maxwell stress"; }
  void set(const Chain<D>& c, Rows rows, State<D>& slope) const override {
    const int i = rows.first, n = rows.size();
    slope.col(stress_column<D>).segment(i, n) = c.strain_rate.segment(i, n) - c.stress.segment(i, n);
  }
  StressDerivative derivative(const Chain<D>&, int) const override {
    StressDerivative d;
    d.by_strain_rate[0] = 1;
    d.by_state(0, 0) = -1;
    return d;
  }
};

template <int D>
class HerschelBulkley final : public StressLaw<D> {
 public:
  /// small_rate: r_0, above 0.
  HerschelBulkley(double yield, double K, double index, double small_rate)
      : yield_(yield), K_(K), index_(index), small_rate_(small_rate) {}
  std::string_view name() const override { return "Herschel-Bulkley stress"; }
  bool extrapolates() const override { return yield_ == 0 && index_ == 1; }

  void set(const Chain<D>& c, Rows rows, State<D>& slope) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const double r = c.strain_rate[i], e = std::hypot(r, small_rate_);
      slope(i, stress_column<D>) = (yield_ + K_ * std::pow(e, index_)) * (r / e) - c.stress[i];
    }
  }
  StressDerivative derivative(const Chain<D>& c, int element) const override {
    const double r = c.strain_rate[element], e = std::hypot(r, small_rate_), part = small_rate_ / e;
    StressDerivative d;
    d.by_strain_rate[0] =
        yield_ / e * part * part + K_ * std::pow(e, index_ - 1) * (1 + (index_ - 1) * (r / e) * (r / e));
    d.by_state(0, 0) = -1;
    return d;
  }

 private:
  double yield_, K_, index_, small_rate_;
};

}  // namespace treejet
