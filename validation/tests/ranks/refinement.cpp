/// Elements of jets in subdomains that are split and merged on the way.

#include <catch2/catch.hpp>
#include <numbers>

#include "forces/distributed/bead_words.hpp"
#include "validation/tests/ranks/flight.hpp"
#include "validation/tests/ranks/ranked.hpp"

using namespace treejet;

namespace {

using Directives = std::vector<std::string>;

struct Scenario {
  const char* what;
  Directives directives;
  double seconds;
  int releases, removals, splits, merges;  ///< at least
};

Directives with(Directives all, const Directives& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Parameters parameters(const Directives& all, const Directives& more) {
  return example("pvp", with(with(all, more), {"dynamic refinement yes", "final time 1"}));
}

/// A bent thread, where nothing is inserted; bends straighten, and others are wound up.
void bend(Run<3>& run) {
  Jet<3>& jet = run.scene.jet;
  const double length = run.parameters.initial_length / run.unit.length;
  for (Eigen::Index i = 0; i < jet.size(); ++i)
    jet.y(i, 1) = 0.2 / run.unit.length * std::sin(3 * std::numbers::pi * jet.y(i, 0) / length);
}

/// `rounded`: from a state each number of which is another one in its last digit.
Flight flight(const Parameters& p, const Ranks& ranks, double seconds, bool rounded = false) {
  Run<3> run(p, {1}, ranks);
  if (!p.inserting) bend(run);
  State<3>& y = run.scene.jet.y;
  for (Eigen::Index i = 0; rounded && i < y.size(); ++i) y.data()[i] *= 1 + 1e-15 * std::cos(double(i * i));
  return flight(run, seconds, seconds / 4);
}

/// In subdomains that add up all pairs, as the whole does: no deck asks for that.
Parameters direct(Parameters p) {
  p.coulomb = CoulombSum::direct;
  return p;
}

const Directives cut = {"parallel distributed", "coulomb tree", "coulomb accuracy 1.d-6"};
const Directives stream = {"tolerance 1.d-7",     "points 60",
                           "initial length 1.2",  "collector distance 1.25",
                           "nozzle velocity 20.", "dynamic refinement threshold 0.045"};
const Directives thread = {"tolerance 1.d-7",
                           "points 20",
                           "initial length 1.6",
                           "inserting no",
                           "removing no",
                           "perturb no",
                           "external potential 0",
                           "density charge 0",
                           "nozzle stress 2.d5",
                           "surface tension model energy",
                           "dynamic refinement tolerance 2.d-2",
                           "dynamic refinement every 2.d-5"};

}  // namespace

TEST_CASE("The same elements are split and merged in subdomains as in the whole jet") {
  const Ranks& ranks = started_ranks();
  const std::vector<Scenario> scenarios = {
      {"beads come and go", stream, 8e-4, 5, 10, 50, 0},
      {"bends straighten", thread, 6e-4, 0, 0, 15, 1},
      {"slender", with(stream, {"self field slender", "surface tension model energy"}), 6e-4, 4, 8, 30, 0},
      {"drying", with(stream, {"evaporation yes", "evaporation polymer frac 0.1"}), 5e-4, 5, 10, 30, 0},
      {"bending", with(stream, {"bending yes", "elastic modulus 1.d6"}), 4e-4, 3, 5, 8, 0},
      {"pushed by number", with(stream, {"noise yes", "noise diffusivity 1.d6", "noise interval 1.d-5"}),
       5e-4, 5, 10, 30, 0}};
  for (const Scenario& s : scenarios) {
    CAPTURE(s.what);
    const Parameters p = parameters(s.directives, {"multirate no"});
    const Flight whole = flight(p, {}, s.seconds), rounded = flight(p, {}, s.seconds, true);
    const Flight subdomains =
        flight(direct(parameters(s.directives, with(cut, {"multirate no"}))), ranks, s.seconds);
    const Effort& e = subdomains.effort;
    CAPTURE(e.released, e.removed, e.split, e.merged, whole.effort.split, whole.effort.merged);
    CHECK(e.released >= s.releases);
    CHECK(e.removed >= s.removals);
    CHECK(e.split >= s.splits);
    CHECK(e.merged >= s.merges);
    CHECK(e.split == whole.effort.split);
    CHECK(e.merged == whole.effort.merged);
    if (ranks.size() > 1 && s.directives == stream) CHECK(subdomains.recuts > 0);
    // sums over subdomains round otherwise; what that leads to is what the last digit at the start leads to,
    // which the slender jet makes some four times as large every 50 us
    const double apart = difference(subdomains, whole, p), of_last_digit = difference(rounded, whole, p);
    CHECK(of_last_digit < 1e-8);
    CHECK(told_by_first(apart, ranks) < 10 * of_last_digit);
    CHECK(ranks.agree(fmt::format("{} {} {}", e.steps, e.split, subdomains.recuts)));
  }
}

TEST_CASE("Splits and merges in subdomains keep mass, charge and volume") {
  const Ranks& ranks = started_ranks();
  const Flight f = flight(parameters(thread, with(cut, {"multirate no"})), ranks, 6e-4);
  CHECK(f.effort.merged > 0);
  double lost = 0;
  if (ranks.first())
    for (const Jet<3>& jet : f.jets)
      for (auto each : {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume})
        lost = std::max(lost, std::abs((jet.*each).sum() / (f.jets[0].*each).sum() - 1));
  CHECK(told_by_first(lost, ranks) < 1e-13);  // round-off of a hundred numbers
}

TEST_CASE("Two rates give the refined jet in subdomains that one rate gives of the whole") {
  const Ranks& ranks = started_ranks();
  const Directives jet = {"dynamic refinement threshold 0.4"};
  constexpr double seconds = 0.0094;
  const Parameters p = parameters(jet, cut);
  const Flight whole = flight(parameters(jet, {"multirate no"}), {}, seconds),
               at_two_rates = flight(parameters(jet, {}), {}, seconds),
               subdomains = flight(p, ranks, seconds);
  CHECK(subdomains.effort.split > 20);
  CHECK(subdomains.effort.split == whole.effort.split);
  // what is continued goes on after a refinement as in the whole; begun anew it takes 1.3 times as many
  CHECK(double(subdomains.full_evaluations) == Approx(double(at_two_rates.full_evaluations)).epsilon(0.02));
  // tolerance 1e-6 stands for 1e-4 cm of 16 cm; the continuation may take half of it
  CHECK(told_by_first(difference(subdomains, whole, p), ranks) < 5e-5 / 16);
}

namespace {

/// A chain on a winding way, each element so long for its volume.
Jet<3> winding(const Eigen::ArrayXd& volume, const Eigen::ArrayXd& length, double turn) {
  Jet<3> jet;
  Vec<3> r = Vec<3>::Zero();
  for (Eigen::Index i = volume.size() - 1; i >= 0; --i) {
    const double angle = turn * std::sin(0.37 * double(i) * double(i));
    r += length[i] * Vec<3>(std::cos(angle), std::sin(angle), 0.2 * angle).normalized();
    const double below = i > 0 ? volume[i - 1] : volume[0], mass = (below + volume[i]) / 2;
    append<3>(jet, Bead<3>(r, Vec<3>(1, std::sin(double(i)), 0), std::cos(double(i)), mass, 0.9 * mass));
    jet.volume[jet.size() - 1] = volume[i];
  }
  // from the nozzle on; a jet begins with the oldest
  const auto rows = Eigen::ArrayXi::LinSpaced(Eigen::Index(jet.size()), int(jet.size()) - 1, 0).eval();
  jet.y = jet.y(rows, Eigen::all).eval();
  for (auto each : bead_constants) jet.*each = (jet.*each)(rows).eval();
  number_beads(jet);
  return jet;
}

/// Elements that ask for all there is: random ones; a stretch of halves that all might merge; volumes that
/// rise over twenty elements from one that is too long, so that the last has to be split first.
Jet<3> asking_jet(const Parameters& p, int beads, bool random) {
  const double longest = *p.refinement_threshold / scales(p).length;
  Eigen::ArrayXd volume = Eigen::ArrayXd::Constant(beads, 0.5),
                 length = Eigen::ArrayXd::Constant(beads, longest / 5);
  for (int i = 0; i < beads && random; ++i) {
    volume[i] = std::exp2(-std::floor(2.5 + 2.5 * std::sin(double(i * i))));
    length[i] = longest * (0.7 + 0.6 * std::cos(1.3 * double(i) * double(i)));
  }
  for (int i = 0; i < 20; ++i) volume[beads / 3 + i] = std::exp2(i - 20);
  length[beads / 3] = 1.1 * longest;
  return winding(volume, length, random ? 0.5 : 0);
}

bool same_rows(const Jet<3>& here, const Jet<3>& whole, const std::vector<int>& rows) {
  bool same = here.size() == std::ssize(rows) && here.born == whole.born;
  same = same && (here.y == whole.y(rows, Eigen::all)).all() && (here.id == whole.id(rows)).all();
  for (auto each : bead_constants) same = same && (here.*each == (whole.*each)(rows)).all();
  return same;
}

}  // namespace

TEST_CASE("Subdomains are refined to the bits of the whole, in other states of the same beads, too") {
  const Ranks& ranks = started_ranks();
  const Parameters p = parameters(stream, {"dynamic refinement tolerance 1.d-2", "nozzle cross 5.d-4"});
  const Spacing<3> spacing(p);
  for (const bool random : {true, false})
    for (const int beads : {40, 101, 400})
      for (const Ends& ends : {Ends{1, 1}, Ends{12, 32}}) {
        CAPTURE(random, beads, ends.old);
        Jet<3> whole = asking_jet(p, beads, random), earlier = whole;
        earlier.y.col(1) += 1e-3 * earlier.y.col(0);
        ChainDecomposition subdomains(beads, ranks, ends);
        Jet<3> here = whole;
        subdomains.take(here, whole);
        std::vector<Jet<3>> alike = {here};
        alike[0].y = earlier.y(subdomains.rows(), Eigen::all);
        const Refinement found = subdomains.refinement(here, spacing), expected = spacing.refinement(whole);
        bool same = found.size() == expected.size();
        for (std::size_t k = 0; same && k < found.size(); ++k)
          same = found[k].kind == expected[k].kind && found[k].rows == expected[k].rows;
        CHECK(ranks.greatest(same ? 0 : 1) == 0);
        CHECK(expected.size() > 1);
        if (ranks.greatest(same ? 0 : 1) > 0) continue;
        subdomains.refine(here, found, alike);
        for (Jet<3>* jet : {&whole, &earlier}) treejet::refine(*jet, expected);
        same = same_rows(here, whole, subdomains.rows()) && same_rows(alike[0], earlier, subdomains.rows());
        CHECK(ranks.greatest(same ? 0 : 1) == 0);
      }
}

TEST_CASE("A refinement sends what is near to the borders of subdomains and which elements, not the jet") {
  const Ranks& ranks = started_ranks();
  const Parameters p = parameters(stream, {});
  const Spacing<3> spacing(p);
  constexpr int beads = 20'000;
  const double longest = *p.refinement_threshold / scales(p).length;
  Eigen::ArrayXd length = Eigen::ArrayXd::Constant(beads, longest / 2);
  for (int i = 100; i < beads; i += beads / 7) length[i] = 1.1 * longest;
  const Jet<3> whole = winding(Eigen::ArrayXd::Ones(beads), length, 0);
  ChainDecomposition subdomains(beads, ranks);
  Jet<3> here = whole;
  subdomains.take(here, whole);
  const RankTraffic before = ranks.traffic();
  const Refinement refinement = subdomains.refinement(here, spacing);
  subdomains.refine(here, refinement, {});
  const RankTraffic after = ranks.traffic();
  CHECK(refinement.size() == 1);
  CHECK(refinement.at(0).rows.size() == 7);
  CHECK(after.tables == before.tables);
  // 100 bytes of each of some 60 beads, to neighbours; all beads would be 2 MB a rank
  CHECK(ranks.greatest(double(after.message_bytes - before.message_bytes)) < 2e4);
}
