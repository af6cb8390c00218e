#include "core/jet/error_norm.hpp"

#include "core/jet/scales.hpp"
#include "core/jet/stiffness.hpp"

namespace treejet {

ErrorNorm::ErrorNorm(const Parameters& p, const Columns& added) {
  for (const Column& column : added) small_.push_back(column.small);
  constexpr double allowance = 25, most = 0.1;
  const Stiffness s = stiffness(p);
  const double T = std::max(1.0, s.bead_interval / s.relaxation);
  length_ = groups(p).L_step;
  velocity_ = length_ / T;
  stress_ = 1 / T;
  tolerance_ = p.tolerance.value_or(0);
  permitted_ = std::min(allowance * tolerance_, most);
}

}  // namespace treejet
