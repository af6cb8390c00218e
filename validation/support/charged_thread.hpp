#pragma once
/// A free straight charged thread, of the fluid of the PVP jet, that carries a helical wave: how fast the
/// wave grows, for which slender-body theory has a closed answer. CGS.
///
///     growth^2 = lambda^2 k^2 / mu (ln(2 / (k a)) - gamma) ,    mu, lambda: mass and charge a length;
///     points at distance l:  ln(1 / (k l)) + 3/2  instead of the bracket.

#include <cmath>
#include <numbers>

namespace treejet {

struct ChargedThread {
  double radius = 5e-3, density = 0.84, charge_density = 44000, wavelength = 0.25, length = 2;

  double k() const { return 2 * std::numbers::pi / wavelength; }
  double section() const { return std::numbers::pi * radius * radius; }
  double rate(double bracket) const {
    return charge_density * section() * k() * std::sqrt(bracket / (density * section()));
  }
  double theory() const { return rate(std::log(2 / (k() * radius)) - std::numbers::egamma); }
  double theory_of_points(int elements) const { return rate(std::log(elements / (length * k())) + 1.5); }

  /// Of a chain of so many elements, from the inner half of its waves.
  double growth(int elements, bool slender) const;
};

}  // namespace treejet
