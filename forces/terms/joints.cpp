#include "forces/terms/joints.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace treejet {

namespace {

using Index = Eigen::Index;

constexpr int window = 16;  ///< K

double weight(double u) {
  const double rest = std::max(1 - u * u, 0.0), square = rest * rest;
  return square * square;
}

/// The chain with what it is thought to go on with: places and charges of its beads.
struct Beads {
  std::vector<double> x, q, volume;
  Index before = 0;  ///< elements thought of in front of the first

  explicit Beads(const Eigen::ArrayXd& given) {
    const Index n = given.size();
    const auto beyond = [&](double volume_of_end) {
      return static_cast<Index>(std::ceil(window * given.maxCoeff() / volume_of_end)) + 1;
    };
    before = beyond(given[0]);
    volume.assign(static_cast<std::size_t>(before), given[0]);
    volume.insert(volume.end(), given.begin(), given.end());
    volume.insert(volume.end(), static_cast<std::size_t>(beyond(given[n - 1])), given[n - 1]);
    x.push_back(0);
    q.push_back(volume.front());
    for (std::size_t e = 0; e < volume.size(); ++e) {
      x.push_back(x.back() + volume[e]);
      q.push_back(e + 1 < volume.size() ? (volume[e] + volume[e + 1]) / 2 : volume[e]);
    }
  }
};

/// A bead where the volume of the elements jumps.
struct Joint {
  double x, jump;  ///< place, and V^2 / 12 above it less that below
};

std::vector<Joint> joints_of(const Eigen::ArrayXd& volume) {
  std::vector<Joint> joints;
  double x = volume[0];
  for (Index j = 1; j < volume.size(); x += volume[j++])
    if (volume[j] != volume[j - 1])
      joints.push_back({x, (volume[j] * volume[j] - volume[j - 1] * volume[j - 1]) / 12});
  return joints;
}

/// What the window leaves out of the repulsion over the cut at x.
double beyond_window(const std::vector<Joint>& joints, double x, double reach) {
  double sum = 0;
  for (const Joint& joint : joints) {
    const double d = joint.x - x;
    sum += (d > 0 ? joint.jump : -joint.jump) * (1 - weight(d / reach)) / (d * d);
  }
  return sum;
}

double repulsion_of_equals() {
  double sum = 0;
  for (int k = 1; k < window; ++k) sum += weight(double(k) / window) / k;
  return sum;
}

}  // namespace

Eigen::ArrayXd tension_of_joints(const Eigen::ArrayXd& volume) {
  const Index n = volume.size();
  Eigen::ArrayXd c = Eigen::ArrayXd::Zero(n);
  if (n == 0 || (volume == volume[0]).all()) return c;
  const Beads beads(volume);
  const double of_equals = repulsion_of_equals();
  const std::vector<Joint> joints = joints_of(volume);
  double x = 0;
  for (Index k = 0; k < n; x += volume[k++]) {
    const auto e = static_cast<std::size_t>(k + beads.before);
    const double V = beads.volume[e], reach = window * V;
    c[k] = beyond_window(joints, x + V / 2, reach);
    std::size_t first = e, last = e + 1;  // beads on either side within reach of the other side
    while (first > 0 && beads.x[e + 1] - beads.x[first - 1] < reach) --first;
    while (last + 1 < beads.x.size() && beads.x[last + 1] - beads.x[e] < reach) ++last;
    const auto alike = [&](double other) { return other == V; };
    if (std::all_of(beads.volume.begin() + static_cast<Index>(first),
                    beads.volume.begin() + static_cast<Index>(last), alike))
      continue;
    double sum = 0;
    for (std::size_t i = first; i <= e; ++i)
      for (std::size_t j = e + 1; j <= last; ++j) {
        const double r = beads.x[j] - beads.x[i];
        sum += beads.q[i] * beads.q[j] / (r * r) * weight(r / reach);
      }
    c[k] += sum - of_equals;
  }
  return c;
}

}  // namespace treejet
