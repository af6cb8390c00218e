#include "forces/scene/scene_description.hpp"

#include <fmt/format.h>

#include "core/jet/scales.hpp"

namespace treejet {

std::string scales_description(const Parameters& p) {
  const Scales s = scales(p);
  const Groups g = groups(p);
  std::string text = fmt::format(
      "scales   L_0 = {:.10g} cm   tau = {:.10g} s   G = {:.10g} g/(cm s^2)   L_0/tau = {:.10g} cm/s\n"
      "bead     l_step = {:.10g} cm   mass = {:.10g} g   charge = {:.10g} statC\n"
      "groups   Q = {:.10g}   V = {:.10g}   F_ve = {:.10g}   A = {:.10g}   F_g = {:.10g}   K_s = {:.10g}\n"
      "         H = {:.10g}   L_step = {:.10g}\n",
      s.length, s.time, s.stress, s.velocity, s.l_step, s.mass, s.charge, g.Q, g.V, g.F_ve, g.A, g.F_g, g.K_s,
      g.H, g.L_step);
  return text;
}

std::string composition(const std::vector<Composed>& composed, const std::vector<Composed>& left_out) {
  std::string text = "composed\n";
  for (const auto& c : composed) text += fmt::format("  {:<28} {}\n", c.term, c.reason);
  text += "left out\n";
  for (const auto& c : left_out) text += fmt::format("  {:<28} {}\n", c.term, c.reason);
  return text;
}

}  // namespace treejet
