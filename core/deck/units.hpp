#pragma once
/// Units of the laboratory and of CGS: what they measure and how many CGS units they are.
///
/// A unit is a product of symbols with whole powers: `Pa s`, `Pa*s`, `g/cm^3`, `kg/m3`, `mN/m`, `g/(cm s)`,
/// `s-1`. Letters count in their case (mPa, MPa), SI prefixes go before SI symbols. A blank is a product;
/// what a product after a quotient divides is not guessed at: `g/cm s` is no unit.
///
/// Charge is a dimension of its own and so is the angle: 1 Hz is 2 pi rad/s. A coulomb is 2997924580 statC
/// and 299.792458 V are one statV, both exact (c = 299792458 m/s by definition; Jackson, Appendix on units).

#include <optional>
#include <string>
#include <string_view>

namespace treejet {

/// Powers of cm, g, s, statC and rad.
struct Dimension {
  int length = 0, mass = 0, time = 0, charge = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

struct Unit {
  Dimension dimension;
  double numerator = 1, denominator = 1;  ///< CGS units in one of this, as a quotient: both often whole
};

/// Empty if the text is no unit.
std::optional<Unit> unit(std::string_view text);

/// A number of units `from` in units `to` of the same dimension.
double converted(double number, const Unit& from, const Unit& to);

/// "a mass density", or the powers where the quantity has no name.
std::string quantity_name(const Dimension& dimension);

/// Units of the laboratory for the quantity, "kg/m3, g/cm3", empty where it has no name.
std::string_view usual_units(const Dimension& dimension);

}  // namespace treejet
