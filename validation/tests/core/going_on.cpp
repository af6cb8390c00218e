#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>

#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/h5md.hpp"
#include "core/jet/material.hpp"
#include "core/restart/origin.hpp"
#include "core/restart/resume.hpp"
#include "forces/scene/scene.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;
namespace fs = std::filesystem;

namespace {

const std::string this_program = program({});
constexpr const char* files[] = {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"};

Deck deck_of(const char* example, const std::vector<std::string>& overrides) {
  return read_deck(std::string(TREEJET_SOURCE_DIR) + "/examples/" + example + "/input.dat", overrides);
}

/// What a run begins with besides its deck.
struct Beginning {
  Checkpoint* resumed = nullptr;
  std::vector<std::string> changes = {};
  Origin* origin = nullptr;
};

template <int D>
bool march(const Deck& deck, const fs::path& directory, std::function<StopRequest()> stop_request,
           const Beginning& from) {
  Scene<D> scene = compose<D>(deck.parameters, {1});
  if (from.origin) scene.jet = jet_of<D>(*from.origin, deck.parameters, scene.columns);
  OutputSetting outputs{directory};
  outputs.quiet = true;
  outputs.made_by = provenance(deck, "");
  if (from.origin) outputs.made_by.begins_with = description(*from.origin, deck.parameters);
  outputs.changes = from.changes;
  Checkpoint* const steps = from.origin ? steps_of(*from.origin, deck.parameters) : nullptr;
  return Simulation<D>(deck, system(scene), {outputs, std::move(stop_request), from.resumed, {}, steps})
      .finish();
}

bool run(
    const Deck& deck, const fs::path& directory,
    std::function<StopRequest()> stop_request = [] { return StopRequest::go_on; },
    const Beginning& from = {}) {
  return deck.parameters.system == 1 ? march<1>(deck, directory, std::move(stop_request), from)
                                     : march<3>(deck, directory, std::move(stop_request), from);
}

/// Stops after so many steps.
std::function<StopRequest()> after(int steps) {
  return [steps]() mutable { return steps-- > 0 ? StopRequest::go_on : StopRequest::stop; };
}

/// What `treejet run --resume --set` does.
bool extend(const fs::path& directory, const std::vector<std::string>& overrides) {
  Resumption found = resumption(directory, this_program, overrides);
  REQUIRE(found.extended);
  return run(found.deck, directory, [] { return StopRequest::go_on; }, {&found.checkpoint, overrides});
}

/// A text without the lines that tell what made it.
std::string content(const fs::path& file) {
  std::istringstream all(read_whole(file));
  std::string kept;
  for (std::string line; std::getline(all, line);)
    if (!line.starts_with("##")) kept += line + "\n";
  return file.extension() == ".dat" ? kept : all.str();
}

std::map<std::string, std::string> bytes_below(const fs::path& directory) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::directory_iterator(directory))
    all[entry.path().filename().string()] = read_whole(entry.path());
  return all;
}

struct Case {
  const char* example;
  double end;
  std::vector<std::string> overrides;
};

/// Two rates, an error-controlled and a fixed step, an implicit pair, a straight jet; beads come and go. The
/// ends are no multiples of the steps.
std::vector<Case> cases() {
  const std::string near = "collector distance 0.05";
  return {{"pvp", 1.03e-3, {"points 60", "initial length 1.2", "collector distance 1.25"}},
          {"pvp", 2.07e-3, {near, "integrator dopri5", "multirate no"}},
          {"pvp", 2.07e-3, {near, "integrator kencarp5", "elastic modulus 5.d7"}},
          {"pvp", 1.00033e-3, {near, "integrator 2", "timestep 1.d-6"}},
          {"pvp", 1.00033e-3, {near, "integrator 1", "timestep 5.d-7", "events step"}},
          {"straight-jet", 1.03e-2, {"collector distance 1."}}};
}

std::vector<std::string> with_outputs(const Case& c) {
  std::vector<std::string> all = c.overrides;
  all.push_back(fmt::format("final time {}", c.end));
  all.push_back(fmt::format("print time {}", c.end / 30));
  all.push_back(fmt::format("print xyz {}", c.end / 17));
  all.push_back(fmt::format("print hdf5 {}", c.end / 13));
  all.push_back("printstat list t x n st vx f l curn curc fcn fcc lp vc svc rc");
  return all;
}

}  // namespace

TEST_CASE("A run extended beyond its end leaves the bytes of one that had the later end at once") {
  for (const Case& c : cases()) {
    CAPTURE(c.example, c.overrides);
    const std::vector<std::string> later = {fmt::format("final time {}", 1.7 * c.end)};
    const Deck deck = deck_of(c.example, with_outputs(c)), longer = changed(deck, later);
    const ScratchDirectory whole, extended, stopped;
    int steps = 0;
    REQUIRE(run(longer, whole.path));
    REQUIRE(run(deck, extended.path, [&] { return ++steps, StopRequest::go_on; }));
    CHECK(fs::exists(extended.path / "checkpoint.end"));
    REQUIRE(extend(extended.path, later));
    for (const char* file : files) CHECK(content(extended.path / file) == content(whole.path / file));

    // the last step is shortened by the end, and the run stopped before it
    REQUIRE_FALSE(run(deck, stopped.path, after(steps - 1)));
    REQUIRE(extend(stopped.path, later));
    for (const char* file : files) CHECK(content(stopped.path / file) == content(whole.path / file));
  }
}

TEST_CASE("What is extended tells from where on, and its record and trajectory the deck it has now") {
  const ScratchDirectory place;
  REQUIRE(run(deck_of("pvp", {"final time 3.d-4", "print time 1.d-4", "print hdf5 1.d-4"}), place.path));
  REQUIRE(extend(place.path, {"final time 5.d-4", "checkpoint 600"}));
  const std::string table = read_whole(place.path / "statdat.dat");
  CHECK_THAT(table, Catch::Contains("## from here on --set \"final time 5.d-4\"\n"));
  CHECK(table.find("## from here on") > table.find(" 2.0"));
  const std::vector<std::string> now = {"print time 1.d-4", "print hdf5 1.d-4", "final time 5.d-4",
                                        "checkpoint 600"};
  CHECK(H5md(place.path / "traj.h5", Hdf5File::Access::read).content().made_by.overrides == now);
  CHECK_THAT(read_whole(place.path / "run.json"),
             Catch::Contains("\"final time 5.d-4\"") && !Catch::Contains("\"final time 3.d-4\""));
}

TEST_CASE("The means and the effort of the shorter run leave the record once it is extended") {
  const ScratchDirectory place;
  REQUIRE(run(deck_of("pvp", {"final time 3.d-4", "print time 1.d-5"}), place.path));
  REQUIRE_THAT(read_whole(place.path / "run.json"),
               Catch::Contains("\"means\"") && Catch::Contains("\"effort\""));
  Resumption found = resumption(place.path, this_program, {"final time 1.d-3"});
  REQUIRE_FALSE(run(found.deck, place.path, after(3), {&found.checkpoint, {"final time 1.d-3"}}));
  CHECK_THAT(read_whole(place.path / "run.json"),
             !Catch::Contains("\"means\"") && !Catch::Contains("\"effort\""));
}

TEST_CASE("A checkpoint knows what its run began with") {
  const ScratchDirectory first, second;
  const Deck deck = deck_of("pvp", {"final time 3.d-4", "print time 1.d-4"});
  REQUIRE(run(deck, first.path));
  Origin state = origin((first.path / "checkpoint.end").string());
  const std::string text = description(state, deck.parameters);
  REQUIRE_FALSE(run(deck, second.path, after(3), {.origin = &state}));
  Resumption stopped = resumption(second.path, this_program);
  REQUIRE(stopped.checkpoint.state.has("begins with"));
  std::string told;
  stopped.checkpoint.state.part("begins with", told);
  CHECK(told == text);
}

TEST_CASE("Nothing but the end of a run that goes on may change") {
  const ScratchDirectory place, silent, brief;
  REQUIRE(run(deck_of("pvp", {"final time 3.d-4", "print time 1.d-4"}), place.path));
  const auto change = [](const ScratchDirectory& at, std::vector<std::string> overrides) {
    return resumption(at.path, this_program, overrides);
  };
  CHECK_FALSE(change(place, {"final time 3.d-4"}).extended);
  CHECK_THROWS_WITH(change(place, {"final time 1", "viscosity 30"}),
                    Catch::Contains("viscosity: 30 here, 20 there") && Catch::Contains("--from"));
  CHECK_THROWS_WITH(change(place, {"final time 2.d-4"}), Catch::Contains("0.0003 s at least"));
  CHECK_THROWS_WITH(change(place, {"final tim 1"}), Catch::Contains("did you mean final time"));

  // rows every hundredth of the final time would stand closer in a run that had the later one at once
  const std::string rows_of_its_own = "# t x\n" + deck_of("pvp", {}).text;
  std::istringstream lines(rows_of_its_own);
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("print time")) text += line + "\n";
  const Deck without = parse_deck(text, "deck", {"final time 3.d-4"});
  REQUIRE(run(without, silent.path));
  CHECK_THROWS_WITH(change(silent, {"final time 1.d-3"}), Catch::Contains("add --set \"print time"));
  CHECK(change(silent,
               {"final time 1.d-3", fmt::format("print time {:.17g}", print_interval(without.parameters))})
            .extended);

  // shorter than the interval of beads, 6e-5 s
  REQUIRE(run(deck_of("pvp", {"final time 1.d-6", "print time 1.d-6"}), brief.path));
  CHECK_THROWS_WITH(change(brief, {"final time 1.d-3"}), Catch::Contains("interval of beads"));
}

TEST_CASE("A run begun with a checkpoint of the same deck goes on to the bit as the other one did") {
  for (const Case& c : cases()) {
    CAPTURE(c.example, c.overrides);
    // fcn and fcc are differences of sums since the start, which another start rounds otherwise
    const Deck deck = changed(deck_of(c.example, with_outputs(c)),
                              {"printstat list t x n st vx f l curn curc lp vc svc rc"});
    const ScratchDirectory whole, stopped, begun;
    int steps = 0;
    REQUIRE(run(deck, whole.path, [&] { return ++steps, StopRequest::go_on; }));
    REQUIRE_FALSE(run(deck, stopped.path, after(steps / 2)));
    const auto before = bytes_below(stopped.path);

    Origin source = origin(stopped.path.string());
    REQUIRE(steps_of(source, deck.parameters));
    REQUIRE(run(deck, begun.path, [] { return StopRequest::go_on; }, {.origin = &source}));
    CHECK(bytes_below(stopped.path) == before);

    // the first row is the state it began with, and the window of the second began there
    std::istringstream mine(content(begun.path / "statdat.dat"));
    const std::string theirs = content(whole.path / "statdat.dat");
    std::string line;
    int same = 0;
    for (int k = 0; std::getline(mine, line); ++k) {
      if (k <= 2) continue;
      same += theirs.find("\n" + line + "\n") != std::string::npos;
      REQUIRE(same == k - 2);
    }
    CHECK(same > 5);
    const H5md all(whole.path / "traj.h5", Hdf5File::Access::read),
        part(begun.path / "traj.h5", Hdf5File::Access::read);
    REQUIRE(part.frames() > 3);
    for (std::uint64_t k = 1; k < part.frames(); ++k) {
      const Frame a = part.frames(k, 1)[0], b = all.frames(all.frames() - part.frames() + k, 1)[0];
      CHECK(a.time == b.time);
      CHECK(a.id == b.id);
      CHECK(a.columns == b.columns);
    }
  }
}

TEST_CASE("The tables of a begun run know no speed of release before the first, and land only what lands") {
  const Deck deck = deck_of("pvp", {"collector distance 0.3", "print time 2.d-5", "print xyz 1",
                                    "final time 8.d-3", "printstat list t vn fcc"});
  const auto rows = [](const fs::path& directory) {
    std::map<std::string, std::pair<double, double>> all;
    std::istringstream lines(content(directory / "statdat.dat"));
    for (std::string line, t, vn, fcc; std::getline(lines, line);)
      if (std::istringstream words(line); line[0] != '#' && words >> t >> vn >> fcc)
        all[t] = {std::strtod(vn.c_str(), nullptr), std::strtod(fcc.c_str(), nullptr)};
    return all;
  };
  const ScratchDirectory whole, first, begun;
  REQUIRE(run(deck, whole.path));
  REQUIRE(run(changed(deck, {"final time 7.d-3"}), first.path));
  Origin source = origin(first.path.string());
  REQUIRE(run(deck, begun.path, [] { return StopRequest::go_on; }, {.origin = &source}));
  const auto as_whole = rows(whole.path), as_begun = rows(begun.path);
  REQUIRE(as_begun.size() > 40);
  std::size_t unknown = 0, alike = 0;
  for (const auto& [t, found] : as_begun) {
    if (std::strtod(t.c_str(), nullptr) <= 7e-3) continue;
    const auto& [vn, fcc] = as_whole.at(t);
    unknown += std::isnan(found.first);
    if (!std::isnan(found.first)) alike += found.first == vn;
    // a bead's way is about that of the one before it, and rows in which one arrives have parts of both
    CHECK(found.second == Approx(fcc).epsilon(0.2));
  }
  CHECK(unknown > 0);  // until one is released
  CHECK((alike > 20 && alike + unknown + 1 >= as_begun.size() - 1));
}

TEST_CASE("A jet that another run begins with is the same in CGS, whatever the new deck's scales") {
  const ScratchDirectory place;
  REQUIRE(run(deck_of("pvp", {"final time 1.d-3", "print hdf5 1.d-4"}), place.path));
  const Deck deck =
      deck_of("pvp", {"final time 1", "viscosity 35", "elastic modulus 7.d4", "nozzle cross 7.d-3",
                      "density mass 1.1", "density charge 3.d4", "initial length 0.03",
                      "collector distance 12", "external potential 11 kV"});
  const Parameters& p = deck.parameters;
  const H5md file(place.path / "traj.h5", Hdf5File::Access::read);
  const Frame source = file.frames(7, 1)[0];
  const Origin o = origin(place.path.string() + "@0.7ms");
  CHECK(o.t == source.time);
  const Jet<3> jet = jet_of<3>(o, p);
  const Frame mine = frame<3>(jet, Nozzle<3>(p), scales(p), p.nozzle_cross);
  CHECK(mine.time == Approx(source.time).epsilon(1e-15));
  CHECK(mine.id == source.id);
  for (std::size_t c = 0; c < mine.columns.size(); ++c) {
    CAPTURE(frame_columns()[c].name);
    const auto nozzle =
        static_cast<std::size_t>(frame_columns()[c].width);  // at the end; it is the new deck's
    const std::vector<double>&a = mine.columns[c], &b = source.columns[c];
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k + nozzle < a.size(); ++k)
      CHECK(a[k] == Approx(b[k]).epsilon(1e-14).margin(1e-300));  // a few roundings
  }

  const Origin last = origin(place.path.string());
  CHECK(last.checkpoint);
  const Jet<3> unchanged = jet_of<3>(last, deck_of("pvp", {"final time 1"}).parameters);
  Jet<3> saved;
  last.checkpoint->state.beginning_of_part("march", saved);
  CHECK((unchanged.y == saved.y).all());  // factors of exactly 1
}

TEST_CASE("A jet begun with a frame is the one that the frame shows, whatever its fluid and its feed") {
  const std::vector<std::vector<std::string>> fluids = {
      {},
      {"feed flow", "flow rate 60 mL/h"},
      {"evaporation yes", "evaporation polymer frac 0.06"},
      {"solvent viscosity 0.3 Pa s"},
      {"kvfluid yes"},
      {"evaporation yes", "evaporation polymer frac 0.06", "kvfluid yes"}};
  for (const auto& fluid : fluids) {
    CAPTURE(fluid);
    const Deck deck = deck_of("pvp", fluid);
    const Parameters& p = deck.parameters;
    Run<3> run(p);
    run.to(5e-4);
    const Jet<3>& jet = run.jet();
    const Material material{viscous_stress(p), run.scene.columns, drying(p)};
    Origin o{"traj.h5", deck, jet.t * run.unit.time, {}, {}, {}};
    o.frame = frame<3>(jet, run.scene.nozzle, run.unit, p.nozzle_cross, material);
    o.frame_columns = frame_columns(frame_columns_of(run.scene.columns));
    for (const char* viscosity : {"viscosity 20.", "viscosity 35."}) {
      std::vector<std::string> overrides = fluid;
      overrides.push_back(viscosity);
      const Parameters other = deck_of("pvp", overrides).parameters;
      Run<3> begun(other);
      begun.scene.jet = jet_of<3>(o, other, begun.scene.columns);
      const Jet<3>& mine = begun.jet();
      REQUIRE(mine.size() == jet.size());
      const Scales from = run.unit, to = begun.unit;
      const double few_roundings = 1e-12;
      const auto same = [&](const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
        CHECK((a - b).abs().maxCoeff() <= few_roundings * b.abs().maxCoeff());
      };
      for (int k = 0; k < 3; ++k) {
        same(mine.y.col(k) * to.length, jet.y.col(k) * from.length);
        same(mine.y.col(3 + k) * to.velocity, jet.y.col(3 + k) * from.velocity);
      }
      same(mine.y.col(stress_column<3>) * to.stress, jet.y.col(stress_column<3>) * from.stress);
      same(mine.mass * to.mass, jet.mass * from.mass);
      same(mine.volume * to.mass, jet.volume * from.mass);
      const double fed = p.feed == Feed::flow ? run.scene.nozzle.drawn(jet) : 0;
      if (p.feed == Feed::flow) {
        CHECK(fed > 1.01);
        CHECK(mine.held);
        CHECK(begun.scene.nozzle.drawn(mine) * to.mass == Approx(fed * from.mass).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("A jet begun with a refined one has no numbers of its beads, unless it refines, too") {
  const ScratchDirectory place;
  const std::vector<std::string> refined = {"dynamic refinement yes", "dynamic refinement threshold 0.4"};
  REQUIRE(run(deck_of("pvp", {"final time 1.d-3", refined[0], refined[1]}), place.path));
  const Origin o = origin(place.path.string());
  const Jet<3> plain = jet_of<3>(o, deck_of("pvp", {"final time 1"}).parameters);
  CHECK(plain.id.size() == 0);
  CHECK(plain.born == 0);
  const Jet<3> numbered = jet_of<3>(o, deck_of("pvp", {"final time 1", refined[0], refined[1]}).parameters);
  CHECK(numbered.id.size() == numbered.size());
  CHECK(numbered.born >= numbered.size());
}

TEST_CASE("A run begun with a frame goes on as the other one within the tolerance of the steps") {
  const std::vector<std::string> overrides = {"final time 4.d-3", "print hdf5 1.d-3", "print time 1.d-3"};
  const Deck deck = deck_of("pvp", overrides);
  const ScratchDirectory whole, begun;
  REQUIRE(run(deck, whole.path));
  Origin source = origin(whole.path.string() + "@2.d-3");
  CHECK_FALSE(steps_of(source, deck.parameters));
  REQUIRE(run(deck, begun.path, [] { return StopRequest::go_on; }, {.origin = &source}));
  const auto last = [](const ScratchDirectory& at) {
    const H5md file(at.path / "traj.h5", Hdf5File::Access::read);
    return file.frames(file.frames() - 1, 1)[0];
  };
  const Frame a = last(whole), b = last(begun);
  REQUIRE(a.id == b.id);
  // tolerance 1e-6 ends 7e-6 cm off at 0.01 s (README), and the steps are other ones
  for (std::size_t k = 0; k < a.columns[0].size(); ++k)
    CHECK(std::abs(a.columns[0][k] - b.columns[0][k]) < 2e-5);
  CHECK_THAT(read_whole(begun.path / "run.json"),
             Catch::Contains("\"begins_with\"") && Catch::Contains("traj.h5, t = 0.002 s"));
}

TEST_CASE("A jet that a deck cannot begin with is refused with the reason") {
  const ScratchDirectory place, straight, empty;
  REQUIRE(run(deck_of("pvp", {"final time 1.d-3", "print hdf5 1.d-4"}), place.path));
  const auto begin = [](const std::string& from, std::vector<std::string> overrides) {
    const Deck deck = deck_of("pvp", overrides);
    return jet_of<3>(origin(from), deck.parameters);
  };
  const std::string here = place.path.string();
  CHECK_THROWS_WITH(begin(here, {"final time 9.d-4"}), Catch::Contains("expected a final time beyond"));
  CHECK_THROWS_WITH(begin(here, {"collector distance 0.05"}),
                    Catch::Contains("beyond the collector distance"));
  CHECK_THROWS_WITH(begin(here, {"density charge 0"}), Catch::Contains("has no charge"));
  CHECK_THROWS_WITH(begin(here + "@0.00035", {}), Catch::Contains("nearest are at 0.0003 and 0.0004 s"));
  CHECK_THROWS_WITH(begin(here + "@1", {}), Catch::Contains("no frame at t = 1 s"));
  CHECK_THROWS_WITH(begin(here + "@3 kV", {}), Catch::Contains("expected a time"));
  CHECK_THROWS_WITH(begin(here + "/nowhere", {}), Catch::Contains("no such directory"));
  CHECK_THROWS_WITH(begin(empty.path.string(), {}), Catch::Contains("neither a checkpoint nor traj.h5"));
  CHECK_THROWS_WITH(jet_of<3>(origin(here), deck_of("pvp", {}).parameters, {{"solvent", "1"}}),
                    Catch::Contains("carry no solvent"));
  CHECK_THROWS_WITH(jet_of<3>(origin(here + "@3.d-4"), deck_of("pvp", {}).parameters, {{"solvent", "1"}}),
                    Catch::Contains("carry no solvent"));
  REQUIRE(run(deck_of("straight-jet", {"final time 1.d-2"}), straight.path));
  CHECK_THROWS_WITH(begin(straight.path.string(), {}), Catch::Contains("of system 1, the deck of system 3"));
}
