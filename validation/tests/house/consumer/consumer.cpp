// Unit charges 2 apart: each feels q / d^2 = 1/4, exact in binary.
#include <cstdio>

#include "core/base/version.hpp"
#include "forces/coulomb/coulomb.hpp"

int main() {
  const double x[] = {0, 2}, y[] = {0, 0}, z[] = {0, 0}, q[] = {1, 1};
  double ex[2], ey[2], ez[2];
  treejet::coulomb_plain<3>({{x, y, z}, q, 2}, {0, 2}, {ex, ey, ez}, 2);
  const treejet::Version version = treejet::version();
  std::printf("Treejet %.*s: E = %g, %g\n", int(version.number.size()), version.number.data(), ex[0], ex[1]);
  return ex[0] == -0.25 && ex[1] == 0.25 ? 0 : 1;
}
