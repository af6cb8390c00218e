#include <catch2/catch.hpp>

#include "core/observe/step_errors.hpp"
#include "integrators/run/error_estimate.hpp"
#include "validation/support/run.hpp"
#include "validation/tests/ranks/files_of_ranks.hpp"

using namespace treejet;
namespace fs = std::filesystem;

namespace {

Deck replicated(const Deck& deck) {
  return changed(deck, {"parallel replicated"});
}

/// As on the first rank, which alone has files of a run that is not cut.
Ended run_alone(const Deck& deck, const fs::path& directory, const Ranks& ranks,
                std::int64_t steps = 1'000'000'000, Origin* from = nullptr) {
  Ended ended;
  const Provenance by = provenance(deck, "");
  if (ranks.first()) ended = run(deck, directory, {}, steps, {.origin = from, .made_by = by});
  ranks.greatest(0);
  return ended;
}

/// Stopped after so many steps; the first rank says how many there are in all.
std::int64_t steps_in_all(const Deck& deck, const Ranks& ranks) {
  const SharedPlace place(ranks);
  return run(deck, place.path, ranks).steps;
}

/// Whether the rows of a table but for the first two, in whose window it began, stand in another.
bool rows_stand_in(const fs::path& part, const fs::path& whole) {
  std::istringstream mine(content(part / "statdat.dat"));
  const std::string theirs = content(whole / "statdat.dat");
  std::string line;
  int rows = 0;
  while (std::getline(mine, line))
    if (!line.starts_with("#") && ++rows > 2 && theirs.find("\n" + line + "\n") == std::string::npos)
      return false;
  return rows > 7;
}

}  // namespace

TEST_CASE(
    "A run of subdomains extended beyond its end leaves the bytes of one that had the later end at once") {
  const Ranks& ranks = started_ranks();
  for (const Deck& deck : {short_jet(), two_rates(), tree_in_space(), refined_jet()}) {
    const double end = deck.parameters.final_time;
    const std::vector<std::string> later = {fmt::format("final time {}", 1.7 * end)};
    const SharedPlace whole(ranks), extended(ranks), stopped(ranks);
    REQUIRE(run(changed(deck, later), whole.path, ranks).arrived);
    const Ended first = run(deck, extended.path, ranks);
    REQUIRE(first.arrived);
    CHECK(of_first(ranks, [&] {
            return fs::exists(extended.path / "checkpoint.end") &&
                   !fs::exists(extended.path / "checkpoint") && !fs::exists(extended.path / "checkpoint.old");
          }) == 1);
    REQUIRE(resume(extended.path, ranks, 1'000'000'000, later).arrived);
    CHECK(of_first(ranks, [&] { return same_files(whole.path, extended.path); }) == 1);

    // the last step is shortened by the end, and the run stopped before it
    REQUIRE_FALSE(run(deck, stopped.path, ranks, first.steps - 2).arrived);
    REQUIRE(resume(stopped.path, ranks, 1'000'000'000, later).arrived);
    CHECK(of_first(ranks, [&] { return same_files(whole.path, stopped.path); }) == 1);
  }
}

TEST_CASE("A run begun with a checkpoint of subdomains goes on to the bit on as many ranks") {
  const Ranks& ranks = started_ranks();
  for (const Deck& with_sums : {short_jet(), two_rates()}) {
    // fcn and fcc are differences of sums since the start, which another start rounds otherwise
    const Deck deck = changed(with_sums, {"printstat list t x n f l yz st vx vc rc curn lp rlp"});
    const SharedPlace whole(ranks), stopped(ranks), begun(ranks);
    const std::int64_t steps = run(deck, whole.path, ranks).steps;
    REQUIRE_FALSE(run(deck, stopped.path, ranks, steps / 3).arrived);
    Origin source = origin(stopped.path.string());
    REQUIRE(steps_of(source, deck.parameters));
    CHECK_FALSE(steps_of(source, replicated(deck).parameters));
    REQUIRE(run(deck, begun.path, ranks, 1'000'000'000, {.origin = &source}).arrived);
    CHECK(of_first(ranks, [&] { return rows_stand_in(begun.path, whole.path); }) == 1);
  }
}

TEST_CASE(
    "A jet goes from subdomains to one rank, and from one rank or a frame to subdomains, bead by bead") {
  const Ranks& ranks = started_ranks();
  const Deck deck = short_jet(), whole_deck = replicated(deck);
  const SharedPlace cut(ranks), alone(ranks);
  const std::int64_t steps = steps_in_all(deck, ranks) / 2;
  REQUIRE_FALSE(run(deck, cut.path, ranks, steps, {.made_by = provenance(deck, "")}).arrived);
  run_alone(whole_deck, alone.path, ranks, steps);
  for (const SharedPlace* from : {&cut, &alone})
    for (const char* frame : {"", "@9e-5"}) {
      const Origin source = origin(from->path.string() + frame);
      const Jet<3> all = jet_of<3>(source, deck.parameters);
      CHECK(all.size() > 50);
      CHECK(ranks.agree(fmt::format("{} {} {}", all.t, all.y.sum(), all.mass.sum())));
      Run<3> run(deck.parameters, {1}, ranks);
      run.scene.decomposition().take(run.scene.jet, all);
      const Jet<3> back = whole<3>(run.scene.decomposition(), run.jet());
      CHECK(of_first(ranks, [&] {
              return back.t == all.t && back.removed == all.removed && (back.y == all.y).all() &&
                     (back.mass == all.mass).all() && (back.charge == all.charge).all() &&
                     (back.volume == all.volume).all();
            }) == 1);
      double own = static_cast<double>(run.scene.decomposition().own_rows(run.jet().size()).second -
                                       run.scene.decomposition().own_rows(run.jet().size()).first);
      CHECK(own < double(all.size()) / ranks.size() + 4);
    }
}

TEST_CASE("A run of subdomains begun with a state of the whole ends as the whole does") {
  const Ranks& ranks = started_ranks();
  const Deck deck = short_jet(), whole_deck = replicated(deck);
  const SharedPlace whole(ranks), stopped(ranks), begun(ranks);
  const std::int64_t steps = steps_in_all(deck, ranks);
  run_alone(whole_deck, stopped.path, ranks, steps / 2);
  Origin source = origin(stopped.path.string());
  CHECK_FALSE(steps_of(source, deck.parameters));
  REQUIRE(run(deck, begun.path, ranks, 1'000'000'000, {.origin = &source}).arrived);
  run_alone(whole_deck, whole.path, ranks, 1'000'000'000, &source);
  // tolerance 1e-6 is 1e-5 in x, and both take steps of their own
  CHECK(of_first(ranks, [&] { return difference(whole.path, begun.path, 4); }) < 1e-5);
}

TEST_CASE("The estimated error of a run of subdomains is that of the whole") {
  const Ranks& ranks = started_ranks();
  const Deck deck = changed(short_jet(), {"timestep 4.d-7", "integrator heun"});
  const auto rows = [&](const Parameters& p) {
    Scene<3> scene = compose<3>(p, {1}, ranks);
    return rows_of_run<3>(p, scene, {}, {}).value();
  };
  const auto estimate = [&](const Parameters& p) {
    const TableOfRows first = rows(p);
    return errors(first, difference(first, rows(finer(p))));
  };
  const auto cut = estimate(deck.parameters), all = estimate(replicated(deck).parameters);
  REQUIRE(cut.size() == all.size());
  REQUIRE(cut[0].label == "x[cm]");
  CHECK(all[0].of_a_row > 1e-9);
  // the field, 1e-5 off, is nearly the same in both runs; their difference is a number of that size
  CHECK(of_first(ranks, [&] { return cut[0].of_a_row / all[0].of_a_row; }) == Approx(1).epsilon(0.05));
}

TEST_CASE("Fixed steps of a jet in subdomains err as measured on the whole") {
  const Ranks& ranks = started_ranks();
  const Deck deck = changed(short_jet(), {"timestep 4.d-7", "integrator heun", "events step"});
  const auto measured = [&](const Parameters& p) {
    Run<3> run(p, {1}, ranks);
    StepErrors<3> errors(run.scene.nozzle, run.scene.collector, EventRule::step, 1, run.scene.decomposition(),
                         true);
    run.to(p.final_time, {&errors});
    return std::tuple(errors.step_error(), errors.lateness(), errors.samples());
  };
  const auto [error, lateness, samples] = measured(deck.parameters);
  const auto [error_of_whole, lateness_of_whole, samples_of_whole] = measured(replicated(deck).parameters);
  CHECK(samples > 10);
  CHECK(samples == samples_of_whole);
  // squares of the same numbers, added in another order, of a field that is 1e-5 off
  CHECK(error == Approx(error_of_whole).epsilon(1e-4));
  CHECK(lateness == Approx(lateness_of_whole).epsilon(1e-4));
  CHECK(ranks.agree(fmt::format("{} {}", error, samples)));
}
