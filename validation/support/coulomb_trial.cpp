#include "validation/support/coulomb_trial.hpp"

#include <algorithm>
#include <ctime>
#include <limits>

#include "validation/support/experiment.hpp"

namespace treejet {

std::vector<NamedSet> NamedSet::all() {
  return {{"straight line", straight_line},
          {"open helix", [](int n) { return coil(n, 10, 1.0); }},
          {"whipping jet", whipping_jet},
          {"simulated jet", simulated_jet},
          {"coil, pitch 1/4", [](int n) { return coil(n, 100, 0.25); }},
          {"coil, pitch 1/20", [](int n) { return coil(n, 400, 0.05); }},
          {"coil, pitch 1/100", [](int n) { return coil(n, 400, 0.01); }},
          {"cloud, both signs", [](int n) { return random_cloud(n); }}};
}

namespace {

/// A cubic through four neighbours, from p1 to p2 (Catmull-Rom).
double between(double p0, double p1, double p2, double p3, double s) {
  return p1 + s / 2 * (p2 - p0 + s * (2 * p0 - 5 * p1 + 4 * p2 - p3 + s * (3 * (p1 - p2) + p3 - p0)));
}

}  // namespace

PointSet simulated_jet(int n) {
  static const Outcome jet =
      experiment(example("pvp", {"points 8", "final time 0.02", "print time 0.02", "tolerance 1e-5"}),
                 {.most_evaluations = 10'000'000});
  const Eigen::Index beads = jet.position.rows();
  PointSet set;
  for (int i = 0; i < n; ++i) {
    const double place = n > 1 ? double(beads - 1) * i / (n - 1) : 0;
    const auto k = std::min<Eigen::Index>(static_cast<Eigen::Index>(place), beads - 2);
    std::array<double, 3> r;
    for (Eigen::Index e = 0; e < 3; ++e)
      r[static_cast<std::size_t>(e)] =
          between(jet.position(std::max<Eigen::Index>(k - 1, 0), e), jet.position(k, e),
                  jet.position(k + 1, e), jet.position(std::min(k + 2, beads - 1), e), place - double(k));
    set.add(r, 1.0 / n);
  }
  return set;
}

double least_seconds(const std::function<void()>& f, double together) {
  const auto now = [] { return double(std::clock()) / CLOCKS_PER_SEC; };
  double least = std::numeric_limits<double>::infinity(), all = 0;
  for (int k = 0; k < 3 || (all < together && k < 100); ++k) {
    const double start = now();
    f();
    const double taken = now() - start;
    least = std::min(least, taken);
    all += taken;
    if (all > 3) break;
  }
  return least;
}

double direct_seconds(const PointSet& set, Isa isa) {
  constexpr double enough = 2e7;  // pairs
  const int n = set.size(), rows = std::min(n, (static_cast<int>(enough / n) / 16 + 1) * 16);
  FieldSet field(n);
  return least_seconds([&] { coulomb_direct<3>(set.view(), {0, rows}, field.view(), isa); }) * n / rows;
}

CoulombTrial tried(const PointSet& set, const TreeShape& shape, Isa isa) {
  const Rows all = {0, set.size()};
  FieldSet field(set.size());
  TreeField tree(isa);
  CoulombTrial trial;
  trial.seconds = least_seconds([&] {
    tree.arrange(set.view(), shape, {1});
    trial.interactions = tree.evaluate(tree.leaves_of(all), all, field.view(), {1});
  });
  trial.error = field_error(set.view(), field.view(), {1});
  return trial;
}

CoulombReport chosen(const PointSet& set, const CoulombRequest& request, Isa isa) {
  FieldSet field(set.size());
  CoulombSolver solver(request, isa);
  solver.field(set.view(), {0, set.size()}, field.view(), {1});
  return solver.report();
}

double log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::ArrayXd u = Eigen::Map<const Eigen::ArrayXd>(x.data(), n).log(),
                 v = Eigen::Map<const Eigen::ArrayXd>(y.data(), n).log();
  u -= u.mean();
  v -= v.mean();
  return (u * v).sum() / u.square().sum();
}

}  // namespace treejet
