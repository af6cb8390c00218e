#include "core/jet/gas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace treejet {

Resistance along(const Gas& gas, double radius, double speed) {
  constexpr double power = 0.81;
  const double c_f_at_speed_1 = 0.65 * std::pow(2 * radius / gas.viscosity, -power);
  return {std::numbers::pi * radius * gas.density * c_f_at_speed_1 * std::pow(speed, 1 - power), 2 - power};
}

Resistance across(const Gas& gas, double radius, double speed) {
  constexpr double creeping = 1e-4, most = 3.64e-7;
  const double reynolds = 2 * radius * speed / gas.viscosity, Re = std::max(reynolds, creeping);
  const double form = 6.8 * std::pow(Re, -0.89), skin = 1.96 / std::sqrt(Re), width = 1 + most * Re * Re,
               wake = 4e-4 * Re / width;
  const double C = 1.18 + form + skin - wake;
  const double dC_dlnRe = -0.89 * form - 0.5 * skin - wake * (2 / width - 1);
  const double effective_speed = Re * gas.viscosity / (2 * radius);
  return {radius * gas.density * C * effective_speed, reynolds < creeping ? 1 : 2 + dC_dlnRe / C};
}

}  // namespace treejet
