/// Means over the steady state, of series whose errors are known.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/philox.hpp"
#include "core/observe/steady_mean.hpp"

using namespace treejet;

namespace {

/// Normal numbers of variance 1, each rho times the one before it and the rest new.
std::vector<double> series(int seed, int n, double rho) {
  std::vector<double> values;
  double x = normal_pair(seed, 1, 0, 0)[0];
  for (int k = 0; k < n; ++k) {
    values.push_back(x);
    x = rho * x + std::sqrt(1 - rho * rho) * normal_pair(seed, 0, k, 0)[0];
  }
  return values;
}

}  // namespace

TEST_CASE("The state at the start is in no mean") {
  SteadyMeans means({"t[s]", "x[cm]"});
  for (int k = 0; k <= 12; ++k) means.row({0.5 * k, 7});
  const auto all = means.means();
  REQUIRE(all.size() == 1);
  CHECK(all[0].key == "x");
  CHECK(all[0].unit == "cm");
  CHECK(all[0].values == 12);
  CHECK(all[0].from == 0.5);
  CHECK(all[0].mean == 7);
}

TEST_CASE("A series of independent values is steady, but for one in a hundred") {
  int steady = 0;
  for (int seed = 1; seed <= 60; ++seed) steady += steady_mean(series(seed, 200, 0)).steady;
  CHECK(steady >= 56);  // the halves differ by more than three of their difference's errors in 0.3 %
}

TEST_CASE("The error of a correlated series has the correlation in it") {
  // of n values with rho = 0.9 the mean varies as of n / 19 independent ones
  constexpr int n = 4000, seeds = 40;
  const double expected = std::sqrt(19. / n);
  double ratio = 0;
  for (int seed = 1; seed <= seeds; ++seed)
    ratio += steady_mean(series(seed, n, 0.9)).error / expected / seeds;
  // an error from n / B blocks scatters by sqrt(B / 2 n), a seventh, and blocks of B take 5 / B too little
  CHECK(ratio == Approx(0.97).margin(0.06));
}
