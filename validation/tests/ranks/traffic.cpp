#include <catch2/catch.hpp>

#include "core/deck/deck.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "forces/scene/scene.hpp"
#include "validation/support/distributed_run.hpp"
#include "validation/support/rank_volume.hpp"
#include "validation/tests/ranks/ranked.hpp"

using namespace treejet;

TEST_CASE("A rank sends in an evaluation of the field, byte by byte, what the model of many ranks says") {
  const Ranks& ranks = started_ranks();
  if (ranks.size() == 1) return;  // sends nothing
  const int points = 9000;
  const std::vector<int> borders = ranks.borders({0, points}, 1);
  for (const char* name : {"jet", "coil"}) {
    const LongChain chain(name);
    const auto of = [&](int rank) {
      return chain.points(points, {borders[index(rank)], borders[index(rank) + 1]});
    };
    for (const bool space : {false, true}) {
      const PointSet own = of(ranks.rank());
      FieldSet field(own.size());
      CoulombSolver solver(
          {.method = CoulombMethod::tree, .accuracy = 1e-4, .space = space, .measured_every = 1'000'000},
          default_isa(), {.subdomains = ranks});
      solver.field(own.view(), {0, own.size()}, field.view(), {1});  // chooses the shape
      const RankTraffic before = ranks.traffic();
      solver.field(own.view(), {0, own.size()}, field.view(), {1});
      const RankTraffic counted = ranks.traffic() - before;
      const auto model = traffic_of(ranks.size(), of, solver.report().shape)[index(ranks.rank())];
      INFO(name << ", rank " << ranks.rank() << "\ncounted " << description(counted) << "\nmodel   "
                << description(model));
      CHECK(ranks.greatest(counted == model ? 0 : 1) == 0);
      CHECK(ranks.greatest(solver.tree().traffic().sent == counted.message_bytes ? 0 : 1) == 0);
      // else nothing would have been compared
      CHECK(ranks.greatest(static_cast<double>(counted.message_bytes)) > 1000);
    }
  }
}

TEST_CASE(
    "A jet in subdomains adds to the field's traffic its neighbours and a sum, on any number of ranks") {
  const Ranks& ranks = started_ranks();
  const Parameters p =
      read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat",
                {"timestep 1.d-6", "integrator heun", "parallel distributed", "coulomb tree"})
          .parameters;
  Scene<3> scene = compose<3>(p, {1}, ranks);
  State<3> slope;
  const auto evaluate = [&] { scene.right_hand_side()(scene.jet, scene.jet.t, scene.jet.y, slope); };
  evaluate();  // chooses the shape
  const RankTraffic before = ranks.traffic();
  evaluate();
  const RankTraffic counted = ranks.traffic() - before;
  const bool alone = ranks.size() == 1;
  const std::int64_t sums = alone ? 0 : 3, decisions = alone ? 0 : 1;
  INFO(description(counted));
  CHECK(counted.exchanges == 0);
  CHECK(counted.tables == 0);
  CHECK(counted.sums == sums);
  CHECK(counted.decisions == decisions);
}
