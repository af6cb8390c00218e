#pragma once
/// A free straight charged thread, of the fluid of the PVP jet, that carries a helical wave: how fast the
/// wave grows, for which slender-body theory has closed answers. No stress, no surface tension. CGS.
///
/// A small wave grows as cosh(s t) from rest,
///
///     s^2 = lambda^2 k^2 / mu (ln(2 / (k a)) - gamma) ,    mu, lambda: mass and charge a length;
///     points at distance l:  ln(1 / (k l)) + 3/2  instead of the bracket.
///
/// A wave of any size on an endless thread stays a helix, for half a turn about any of its radii leaves the
/// helix as it is, so that every force is along the radius. Its radius A, scaled by k to R = k A, obeys
///
///     R'' = lambda^2 k^2 / mu F(R) ,    c = sqrt(1 + R^2) ,   chord^2 = x^2 + 4 R^2 sin^2(x / 2) ,
///     F = R / c^3 (ln(2 c / (k a)) - 3/2) + integral over 0 < x of
///                        (4 R sin^2(x / 2) / chord^3 - [x < 1] R / (c^3 x)) ,      a^2 = a_0^2 / c ,
///
/// minus the derivative of the energy of the tube (forces/terms/slender_self_field.hpp) by its radius, as a
/// -> 0.

#include <cmath>
#include <numbers>

#include "core/jet/jet.hpp"

namespace treejet {

struct ChargedThread {
  double radius = 5e-3, density = 0.84, charge_density = 44000, wavelength = 0.25, length = 2;

  double k() const { return 2 * std::numbers::pi / wavelength; }
  double section() const { return std::numbers::pi * radius * radius; }
  /// Growth rate of a wave, given the bracket.
  double rate(double bracket) const {
    return charge_density * section() * k() * std::sqrt(bracket / (density * section()));
  }
  double theory() const { return rate(std::log(2 / (k() * radius)) - std::numbers::egamma); }
  double theory_of_points(int elements) const { return rate(std::log(elements / (length * k())) + 1.5); }

  /// F of the endless helix, R as above.
  double push_on_helix(double R) const;
  /// Radius of the endless helix after `seconds` over the one it has at rest before.
  double amplification_of_helix(double amplitude, double seconds) const;

  /// Of a chain of so many elements, from the inner half of its waves.
  double growth(int elements, bool slender) const;
  /// Of the chain, integrated in time: root mean square of the distances from the axis in the inner `part`
  /// of its beads.
  double amplification(int elements, bool slender, double amplitude, double seconds, double part = 0.5) const;

 private:
  Jet<3> wave(int elements, double amplitude) const;
};

/// A wave that grows to a quarter of its own length, on a thread of which 32 elements a wave are as long as 6
/// radii. Its middle, where the amplification is taken, feels the ends by 1e-3.
struct LargeWave {
  ChargedThread thread{.radius = 1.25e-3, .length = 4};
  double amplitude = 4e-3, small = 1e-6, seconds = 6e-4, part = 1. / 8;
};

}  // namespace treejet
