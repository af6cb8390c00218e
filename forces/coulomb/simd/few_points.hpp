#pragma once
/// Up to so many points the whole Coulomb field is summed by Newton's third law, by one worker: the partial
/// sums of more leave the second-level cache.

namespace treejet {

constexpr int few_points = 512;

}  // namespace treejet
