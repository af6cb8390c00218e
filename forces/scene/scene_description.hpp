#pragma once
/// What `treejet check` tells of a scene: scales, dimensionless groups, what was composed and what was left
/// out, and why.

#include <string>

#include "forces/scene/scene.hpp"

namespace treejet {

std::string scales_description(const Parameters& parameters);

std::string composition(const std::vector<Composed>& composed, const std::vector<Composed>& left_out);

}  // namespace treejet
