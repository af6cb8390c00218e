#pragma once
/// Some beads of a jet, by number: what a rank begins with that holds no more of it.

#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

inline Jet<3> part(const Jet<3>& whole, const std::vector<int>& rows) {
  Jet<3> some = at<3>(whole, whole.t, whole.y(rows, Eigen::all));
  for (auto* constants : {&some.mass, &some.charge, &some.volume}) *constants = (*constants)(rows).eval();
  return some;
}

}  // namespace treejet
