#pragma once
/// Constitutive equations of an element, scaled (stress by G, time by mu / G):
///     Maxwell             d sigma/dt = rate - sigma
///     Herschel-Bulkley    d sigma/dt = sgn(rate) ( sigma_Y + K |rate|^nu ) - sigma
/// with rate = (1/l) dl/dt. JETSPIN leaves the sign out: for an element that shortens it gives NaN (nu not an
/// integer) or stress that grows; and its yield stress acts on elements at rest. For elements that stretch
/// both agree. Source: paper, constitutive equation; the Herschel-Bulkley options are JETSPIN's.

#include <cmath>

#include "forces/terms/term.hpp"

namespace treejet {

template <int D>
class Maxwell final : public StressLaw<D> {
 public:
  std::string_view name() const override { return "Maxwell stress"; }
  void set(const Chain<D>& c, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const override {
    const int i = rows.first, n = rows.size();
    rate.segment(i, n) = c.strain_rate.segment(i, n) - c.stress.segment(i, n);
  }
  double by_strain_rate(const Chain<D>&, int) const override { return 1; }
};

template <int D>
class HerschelBulkley final : public StressLaw<D> {
 public:
  HerschelBulkley(double yield, double K, double index) : yield_(yield), K_(K), index_(index) {}
  std::string_view name() const override { return "Herschel-Bulkley stress"; }
  void set(const Chain<D>& c, Rows rows, Eigen::Ref<Eigen::ArrayXd> rate) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const double strain_rate = c.strain_rate[i];
      const double viscous = strain_rate == 0 ? 0 : yield_ + K_ * std::pow(std::abs(strain_rate), index_);
      rate[i] = std::copysign(viscous, strain_rate) - c.stress[i];
    }
  }
  /// Infinite at rest for a fluid that thins with the strain rate: there 1 stands in.
  double by_strain_rate(const Chain<D>& c, int element) const override {
    const double slope = K_ * index_ * std::pow(std::abs(c.strain_rate[element]), index_ - 1);
    return std::isfinite(slope) ? slope : 1;
  }

 private:
  double yield_, K_, index_;
};

}  // namespace treejet
