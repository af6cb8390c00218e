#pragma once
/// One measured run of the field of a chain held in subdomains, by the ranks it is started with; each makes
/// its own one and nothing more.

#include <string>

#include "forces/coulomb/tree/tree_field.hpp"
#include "parallel/ranks.hpp"
#include "validation/support/point_sets.hpp"

namespace treejet {

/// Chains of which any stretch can be made alone, n points at equal distances along a curve.
class LongChain {
 public:
  /// "jet": a whipping jet of 40 turns that widen along the axis. "coil": 1000 turns of radius 1 and pitch
  /// 0.01, where subdomains far along the chain are near in space.
  explicit LongChain(const std::string& kind);
  /// Those of n points that stand in `rows`, or of each `stride` runs of so many the first one.
  PointSet points(int n, Rows rows, int stride = 1, int run = 1) const;

 private:
  std::function<std::array<double, 3>(double)> curve_;
  std::vector<double> length_;
};

struct DistributedRun {
  std::string chain = "jet";
  int points = 100'000, threads = 1, evaluations = 1;
  double accuracy = 1e-5;
};

/// Numbers of a rank are the largest of any.
struct DistributedMeasurement {
  int points = 0, ranks = 0;
  double seconds = 0;              ///< of an evaluation, exchanges included; the least
  double error = 0, expected = 0;  ///< relative L2: at other points than the program's own; its bound
  double sent = 0, received = 0;   ///< bytes of an evaluation
  double cells = 0, grafted = 0, partners = 0;  ///< cells and points received; ranks that sent messages
  double held = 0, before = 0,
         process = 0;       ///< bytes: structures; most the process ever had, before and after
  double unlike_model = 0;  ///< ranks that send anything else than rank_volume.hpp says
  double work = 0;          ///< of the busiest rank, in direct pairs
  TreeShape shape;
};

DistributedMeasurement measure(const DistributedRun& run, const Ranks& ranks);

/// One line, and back.
std::string text(const DistributedMeasurement& m);
DistributedMeasurement distributed_measurement(const std::string& text);

}  // namespace treejet
