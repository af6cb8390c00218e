#pragma once
/// The table of schemes: what a deck calls each one and what the program has to know about it. Messages,
/// documentation, step control and the choice of forces read it; what makes a scheme stands in
/// integrators/run/scheme_registry.cpp.

#include <array>
#include <string>
#include <string_view>

#include "core/jet/parameters.hpp"

namespace treejet {

struct SchemeProperties {
  Scheme scheme;
  std::string_view word;    ///< in a deck
  std::string_view number;  ///< JETSPIN's, also understood; empty if it has none
  std::string_view name;
  int order;      ///< of the result; of an adaptive scheme its error estimate is of this order in h, too
  bool adaptive;  ///< estimates its error and goes with tolerance, else with timestep
  bool implicit;  ///< solves for the local terms
  double share;   ///< of what a tolerance permits, for the estimate of a step: so all schemes err alike
};

/// The row `auto` stands for whichever adaptive scheme the program chooses.
inline constexpr auto schemes = std::to_array<SchemeProperties>({
    {Scheme::automatic, "auto", "", "auto", 0, true, false, 1},
    {Scheme::euler, "euler", "1", "Euler", 1, false, false, 1},
    {Scheme::heun, "heun", "2", "Heun", 2, false, false, 1},
    {Scheme::rk4, "rk4", "3", "Runge-Kutta 4", 4, false, false, 1},
    {Scheme::dopri5, "dopri5", "", "Dormand-Prince 5(4)", 5, true, false, 0.1},
    {Scheme::verner6, "verner6", "", "Verner 6(5)", 6, true, false, 1},
    {Scheme::kencarp5, "kencarp5", "", "Kennedy-Carpenter 5(4), local terms implicit", 5, true, true, 0.1},
});

constexpr const SchemeProperties& properties(Scheme scheme) {
  for (const auto& s : schemes)
    if (s.scheme == scheme) return s;
  return schemes[0];
}

constexpr std::string_view name(Scheme scheme) {
  return properties(scheme).name;
}

/// "auto, dopri5, verner6 and kencarp5", or "1 (euler), 2 (heun) and 3 (rk4)" with numbers.
std::string scheme_words(bool adaptive, std::string_view conjunction, bool numbers = false);

}  // namespace treejet
