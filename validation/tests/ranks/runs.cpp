#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "validation/tests/ranks/flight.hpp"
#include "validation/tests/ranks/ranked.hpp"

using namespace treejet;

namespace {

using Directives = std::vector<std::string>;

Parameters stream(int points, const Directives& steps, const Directives& more = {}) {
  Directives all = {"final time 1", "print time 1", "printstat list t", "perturb ampl 1.d-3",
                    fmt::format("points {}", points)};
  all.insert(all.end(), steps.begin(), steps.end());
  all.insert(all.end(), more.begin(), more.end());
  return read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat", all).parameters;
}

Directives in_subdomains(const std::string& accuracy) {
  return {"parallel distributed", "multirate no", "coulomb tree", "coulomb accuracy " + accuracy};
}

Directives in_subdomains_at_two_rates(const std::string& accuracy) {
  return {"parallel distributed", "coulomb tree", "coulomb accuracy " + accuracy};
}

/// No two beads of the initial jet weigh, repel or fill alike: what takes one number for another shows.
void make_unequal(Scene<3>& scene) {
  const auto* pieces = dynamic_cast<const ChainDecomposition*>(&scene.decomposition());
  for (Eigen::Index i = 0; i < scene.jet.size(); ++i) {
    const double bead = pieces ? pieces->rows().at(static_cast<std::size_t>(i)) : int(i);
    scene.jet.mass[i] = 1.1 + 0.2 * std::sin(bead);
    scene.jet.charge[i] = 1 + 0.1 * std::cos(2 * bead);
    scene.jet.volume[i] = 0.9 + 0.1 * std::sin(3 * bead);
  }
}

Flight flight(const Parameters& p, const Ranks& ranks, double seconds, double interval) {
  Run<3> run(p, {1}, ranks);
  make_unequal(run.scene);
  return flight(run, seconds, interval);
}

}  // namespace

TEST_CASE("A run of subdomains is the replicated one through insertions, removals and new cuts") {
  const Ranks& ranks = started_ranks();
  const double seconds = 1e-3, interval = 2e-4;
  const Flight whole = flight(stream(60, {"tolerance 1.d-7", "multirate no"}), {}, seconds, interval);
  const Parameters p = stream(60, {"tolerance 1.d-7"}, in_subdomains("1.d-6"));
  const Flight subdomains = flight(p, ranks, seconds, interval);
  CHECK(subdomains.effort.released > 10);
  CHECK(subdomains.effort.removed > 10);
  if (ranks.size() > 1) CHECK(subdomains.recuts > 0);
  // a millionth of the field moves no bead by more than that part of its way
  CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 1e-6);
  CHECK(
      ranks.agree(fmt::format("{} {} {}", subdomains.t, subdomains.effort.steps, subdomains.effort.removed)));
}

TEST_CASE("A run of subdomains at two rates is the replicated one at two rates") {
  const Ranks& ranks = started_ranks();
  for (const auto& [points, seconds] : {std::pair{60, 1e-3}, std::pair{300, 1e-4}}) {
    const double interval = seconds / 4;
    // less charge, or short waves would grow and nothing be continued
    const Directives calm = {"tolerance 1.d-7", "density charge 2.d3"};
    const Flight whole = flight(stream(points, calm), {}, seconds, interval);
    const Parameters p = stream(points, calm, in_subdomains_at_two_rates("1.d-6"));
    const Flight subdomains = flight(p, ranks, seconds, interval);
    CHECK(subdomains.effort.released > 3);
    CHECK(subdomains.effort.removed > 3);
    CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 1e-6);  // as above
    // a step evaluates the ends only: full evaluations are few, and about as many here as there; when one is
    // due turns on errors of the field now and then
    CHECK(subdomains.full_evaluations < subdomains.effort.evaluations / 4);
    CHECK(double(subdomains.full_evaluations) == Approx(double(whole.full_evaluations)).epsilon(0.1));
    CHECK(ranks.agree(
        fmt::format("{} {} {}", subdomains.t, subdomains.effort.steps, subdomains.full_evaluations)));
  }
}

TEST_CASE("Subdomains have every local term and meet events at the ends of steps as the whole does") {
  const Ranks& ranks = started_ranks();
  const double seconds = 4e-4, interval = 1e-4;
  const std::vector<Directives> scenes = {
      {"tolerance 1.d-7", "self field slender", "surface tension model energy"},
      {"tolerance 1.d-7", "evaporation yes", "evaporation polymer frac 0.1"},
      {"tolerance 1.d-7", "evaporation yes", "evaporation polymer frac 0.5", "evaporation diffusivity 30.",
       "self field slender"},  // elements end to dry
      {"tolerance 1.d-7", "hbfluid yes", "hbfluid consistency 1.", "hbfluid index 0.8"},
      {"timestep 2.d-7", "integrator heun", "events step"},
      // thick and stiff: bending moves beads by a hundredth of the distance
      {"tolerance 1.d-7", "bending yes", "nozzle cross 0.02", "elastic modulus 1.d6"},
      // pushes that go with the number of a bead since the start
      {"timestep 2.d-7", "integrator sra1", "noise yes", "noise diffusivity 1.d6"},
      {"timestep 2.d-7", "integrator heun", "airdrag yes", "airdrag model full", "noise yes",
       "noise diffusivity 1.d6", "noise interval 3.d-6"}};
  for (const Directives& steps : scenes) {
    CAPTURE(steps);
    const Flight whole = flight(stream(60, steps, {"multirate no"}), {}, seconds, interval);
    const Parameters p = stream(60, steps, in_subdomains("1.d-6"));
    const Flight subdomains = flight(p, ranks, seconds, interval);
    CHECK(subdomains.effort.removed > 2);
    CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 1e-6);  // as above
  }
}

TEST_CASE("The scheme that solves for local terms solves for those of all subdomains at once") {
  const Ranks& ranks = started_ranks();
  const double seconds = 2e-4, interval = 1e-4;
  const std::vector<Directives> scenes = {{"elastic modulus 1.d7"},  // waves cross the jet within a step
                                          {"stress law giesekus", "stress law mobility 0.1",
                                           "solvent viscosity 5.", "airdrag yes", "airdrag amplitude 100."},
                                          {"model slender", "flow rate 0.5 mL/h"}};
  for (Directives steps : scenes) {
    steps.insert(steps.end(), {"tolerance 1.d-6", "integrator kencarp5"});
    CAPTURE(steps);
    const Flight whole = flight(stream(60, steps), {}, seconds, interval);
    const Parameters p = stream(60, steps, in_subdomains("1.d-6"));
    const Flight subdomains = flight(p, ranks, seconds, interval);
    CHECK(subdomains.effort.released > 1);
    // of the field, and so of the way, as above; the systems differ by round-off
    CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 1e-6);
    CHECK(ranks.agree(fmt::format("{} {}", subdomains.t, subdomains.effort.steps)));
    CHECK(double(subdomains.effort.steps) == Approx(double(whole.effort.steps)).epsilon(0.02));
  }
}

TEST_CASE("Subdomains of a jet that is fed by flow move as the whole one does") {
  const Ranks& ranks = started_ranks();
  const double seconds = 4e-4, interval = 1e-4;
  const Directives fed = {"tolerance 1.d-7", "model slender", "flow rate 0.5 mL/h"};
  const Flight whole = flight(stream(60, fed, {"multirate no"}), {}, seconds, interval);
  const Parameters p = stream(60, fed, in_subdomains("1.d-6"));
  const Flight subdomains = flight(p, ranks, seconds, interval);
  CHECK(subdomains.effort.released > 3);
  CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 1e-6);  // of the field, and so of the way
}

TEST_CASE("Subdomains of a jet that is fed by flow keep at two rates what the whole one has at one") {
  const Ranks& ranks = started_ranks();
  const double seconds = 2e-3, interval = 5e-4;
  const auto jet = [](const Directives& more) {
    Directives all = {"tolerance 1.d-9", "points 60", "initial length 1.2", "feed flow", "flow rate 60 mL/h"};
    all.insert(all.end(), more.begin(), more.end());
    return example("pvp", all);
  };
  const Flight whole = flight(jet({"multirate no"}), {}, seconds, interval);
  const Parameters p = jet(in_subdomains_at_two_rates("1.d-6"));
  const Flight subdomains = flight(p, ranks, seconds, interval);
  CHECK(subdomains.effort.released > 1);
  CHECK(3 * subdomains.full_evaluations < 2 * subdomains.effort.evaluations);
  // what two rates err falls with the tolerance: 4e-5 of the whole jet at 1e-7, 2e-6 here
  CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 1e-5);
}

TEST_CASE("A run of subdomains that see each other through expansions keeps the accuracy") {
  const Ranks& ranks = started_ranks();
  const double seconds = 2e-5, interval = 1e-5;
  const Directives steps = {"timestep 1.d-6", "integrator heun"};
  const Flight whole = flight(stream(900, steps), {}, seconds, interval);
  const Parameters p = stream(900, steps, in_subdomains("1.d-4"));
  const Flight subdomains = flight(p, ranks, seconds, interval);
  CHECK(subdomains.effort.removed > 2);
  const double apart = told_by_first(difference(subdomains, whole, p), ranks);
  CHECK(apart > 0);
  // the Coulomb force moves beads by less than a thousandth of the way meanwhile, and is 1e-4 off
  CHECK(apart < 1e-7);
}

TEST_CASE("Subdomains of a jet of one bead, and of one that empties") {
  const Ranks& ranks = started_ranks();
  // from a single bead to several, with more ranks than beads
  Parameters p = stream(2, {"tolerance 1.d-6"}, in_subdomains("1.d-5"));
  p.points = 1;
  p.initial_length = 0.1;
  Parameters alone = p;
  alone.parallel = ParallelData::replicated;
  alone.coulomb = CoulombSum::direct;
  const Flight subdomains = flight(p, ranks, 4e-3, 1e-3), whole = flight(alone, {}, 4e-3, 1e-3);
  CHECK(subdomains.effort.released > 3);
  CHECK(told_by_first(difference(subdomains, whole, p), ranks) <
        1e-5);  // the accuracy of the field, as above
  // nothing follows what leaves
  p = stream(6, {"tolerance 1.d-6"}, in_subdomains("1.d-5"));
  p.inserting = false;
  p.perturb = false;
  const Flight emptied = flight(p, ranks, 1e-2, 1e-3);
  CHECK(emptied.effort.removed == 6);
}

TEST_CASE(
    "The writing rank gets the beads of all subdomains in their order, each portion told what is before it") {
  const Ranks& ranks = started_ranks();
  Run<3> run(stream(60, {"tolerance 1.d-6"}, in_subdomains("1.d-5")), {1}, ranks);
  run.scene.jet.removed = 7;
  std::int64_t next = 7;
  bool right = true;
  run.scene.decomposition().in_portions(run.scene.jet, 60, [&](const Jet<3>& some) {
    right = right && some.removed == next;
    next += some.size();
  });
  CHECK(ranks.greatest(right ? 0 : 1) == 0);
  if (ranks.first()) CHECK(next == 7 + 60);
  const Jet<3> whole = Run<3>(stream(60, {"tolerance 1.d-6"})).jet();
  const Vec<3> nozzle = run.scene.nozzle.position(0);
  // the same lengths, added in another order
  CHECK(run.scene.decomposition().path_length(run.jet().y, nozzle) ==
        Approx(path_length<3>(whole.y, nozzle)).epsilon(1e-13));
}

TEST_CASE("An error that is no number on one rank lets no rank go on") {
  const Ranks& ranks = started_ranks();
  const ChainDecomposition pieces(40, ranks);
  const bool last = ranks.rank() == ranks.size() - 1;
  CHECK(pieces.greatest(last ? std::nan("") : 0.5) == std::numeric_limits<double>::infinity());
  CHECK(pieces.greatest(last ? 0.75 : 0.5) == 0.75);
}

TEST_CASE("Every rank knows which beads it holds, however many there are") {
  const Ranks& ranks = started_ranks();
  for (const Ends& ends : {Ends{1, 1}, Ends{12, 32}})
    for (const int beads : {1, 2, 5, 9, 40, 44, 60, 100}) {
      const ChainDecomposition subdomains(beads, ranks, ends);
      const std::vector<int> rows = subdomains.rows();
      const Rows own = subdomains.own();
      bool right = std::is_sorted(rows.begin(), rows.end(), std::less_equal<>());
      for (int i = own.first + 1; i < own.last; ++i)
        right = right && rows.at(static_cast<std::size_t>(i)) == rows.at(static_cast<std::size_t>(i) - 1) + 1;
      for (int bead = 0; bead < beads; ++bead)
        if (bead < ends.old || bead >= beads - ends.young)
          right = right && std::binary_search(rows.begin(), rows.end(), bead);
      double count = own.size();
      ranks.sum({&count, 1});
      CHECK(count == beads);
      CHECK(ranks.greatest(right ? 0 : 1) == 0);
    }
}
