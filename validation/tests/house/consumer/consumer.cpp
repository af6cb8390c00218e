// Another project's program: its own core/, our headers under treejet/, arrays that cross the border both
// ways.
#include <cmath>
#include <cstdio>

#include "core/jet/jet.hpp"
#include "treejet/core/base/version.hpp"
#include "treejet/core/deck/deck.hpp"
#include "treejet/core/jet/scales.hpp"
#include "treejet/forces/coulomb/coulomb.hpp"
#include "treejet/forces/scene/scene.hpp"
#include "treejet/integrators/run/integration.hpp"

// Unit charges 2 apart: each feels q / d^2 = 1/4, exact in binary.
bool pair_of_charges() {
  const double x[] = {0, 2}, y[] = {0, 0}, z[] = {0, 0}, q[] = {1, 1};
  double ex[2], ey[2], ez[2];
  treejet::coulomb_plain<3>({{x, y, z}, q, 2}, {0, 2}, {ex, ey, ez}, 2);
  std::printf("E = %g, %g\n", ex[0], ex[1]);
  return ex[0] == -0.25 && ex[1] == 0.25;
}

// The jet is allocated in the library, grown and copied here, marched there, and freed here.
bool growing_jet() {
  const treejet::Parameters p = treejet::parse_deck(treejet::deck_template(), "template").parameters;
  treejet::Scene<3> scene = treejet::compose<3>(p, {1});
  for (int i = 0; i < 9; ++i) {
    const treejet::Vec<3> above = treejet::position<3>(scene.jet.y, scene.jet.size() - 1) * 0.5;
    append(scene.jet, treejet::Bead<3>(above));
  }
  const treejet::Jet<3> before = scene.jet;
  treejet::Integration<3> integration(p, treejet::system(scene));
  const double end = 1e-6 / treejet::scales(p).time;
  integration.march.to(end);
  const bool moved =
      scene.jet.t == end && scene.jet.y.allFinite() && (scene.jet.y - before.y).abs().maxCoeff() > 0;
  std::printf("%d beads to t = %g\n", int(scene.jet.size()), scene.jet.t);
  return moved;
}

int main() {
  const treejet::Version version = treejet::version();
  std::printf("Treejet %.*s and a fountain of height %g\n", int(version.number.size()), version.number.data(),
              Fountain().height);
  return pair_of_charges() && growing_jet() ? 0 : 1;
}
