/// The cutoff: a bead feels those at most `reach` points away along the chain, on both sides.

#include <catch2/catch.hpp>

#include "forces/coulomb/solver/direct_sum.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// Charges 1, 2, 4, 8, 16, 32 a unit apart on a line.
constexpr double x[6] = {0, 1, 2, 3, 4, 5}, zero[6] = {}, q[6] = {1, 2, 4, 8, 16, 32};

/// Of those one and two places off: from the left q and q / 4, against those from the right.
constexpr double by_hand[6] = {
    -2 - 4 / 4.,     1 - 4 - 8 / 4., 2 + 1 / 4. - 8 - 16 / 4., 4 + 2 / 4. - 16 - 32 / 4.,
    8 + 4 / 4. - 32, 16 + 8 / 4.};

}  // namespace

TEST_CASE("Six beads with a reach of two feel the two on either side, and no other") {
  double E[3][6];
  DirectSum<3> along_x(2);
  along_x.field({{x, zero, zero}, q, 6}, {0, 6}, {E[0], E[1], E[2]}, {1});
  double straight[6];
  DirectSum<1> in_one_dimension(2);
  in_one_dimension.field({{x}, q, 6}, {0, 6}, {straight}, {1});
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    CHECK(E[0][i] == Approx(by_hand[i]).epsilon(1e-15));  // a few roundings
    CHECK(E[1][i] == 0);
    CHECK(straight[i] == Approx(by_hand[i]).epsilon(1e-15));
  }
}

TEST_CASE("A reach of any length leaves out the pairs beyond it, those of more than half the jet, too") {
  for (const int reach : {1, 3, 4, 5}) {
    double E[6];
    DirectSum<1> sum(reach);
    sum.field({{x}, q, 6}, {0, 6}, {E}, {1});
    for (int i = 0; i < 6; ++i) {
      CAPTURE(reach, i);
      double expected = 0;
      for (int j = 0; j < 6; ++j)
        if (j != i && std::abs(i - j) <= reach) expected += q[j] * (i > j ? 1 : -1) / ((i - j) * (i - j));
      CHECK(E[i] == Approx(expected).epsilon(1e-15));  // a few roundings
    }
  }
}

TEST_CASE("A cutoff of one and a half intervals of beads reaches two of them") {
  // the beads of a new jet stand an interval apart, unit charges: 1 and 1/4 from either side
  Parameters p = read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat", {"points 6", "tolerance 1.d-6"})
                     .parameters;
  const double interval = scales(p).l_step;
  p.cutoff = 1.5 * interval;
  Run<3> run(p);
  const auto& jet = run.scene.jet;
  State<3> slope;
  (*run.scene.motion)(jet, jet.t, jet.y, slope);
  const auto& field = run.scene.motion->coulomb()->field();
  const double one = std::pow(scales(p).length / interval, 2);
  CHECK(jet.size() >= 6);
  // the oldest bead: those behind it only, the third is out of reach
  CHECK(std::abs(field(0, 0)) == Approx(1.25 * one).epsilon(1e-12));
  // the third: two on either side balance, but for the rounding of their places
  CHECK(std::abs(field(2, 0)) < 1e-12 * one);
  // the second: one before it, two behind
  CHECK(std::abs(field(1, 0)) == Approx(0.25 * one).epsilon(1e-12));
}
