#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/directory_lock.hpp"
#include "core/restart/resume.hpp"
#include "core/restart/stop_request.hpp"
#include "forces/scene/scene.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;
namespace fs = std::filesystem;

namespace {

const std::string this_program = program({});

void overwrite(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

struct Case {
  const char* example;
  std::vector<std::string> overrides;
};

Deck deck_of(const Case& c) {
  return read_deck(std::string(TREEJET_SOURCE_DIR) + "/examples/" + c.example + "/input.dat", c.overrides);
}

/// On from the checkpoint, or from the start, until `wish` says stop. True if the end was reached.
template <int D>
bool march(const Deck& deck, const fs::path& directory, std::function<StopRequest()> stop_request,
           Checkpoint* from, int threads) {
  Scene<D> scene = compose<D>(deck.parameters, {threads});
  Simulation<D> simulation(deck, {scene.jet, scene.right_hand_side(), scene.nozzle, scene.collector},
                           {{directory, OutputFile::Existing::keep, true, false, {}, {}, scene.force_error()},
                            std::move(stop_request),
                            from});
  const bool arrived = simulation.finish();
  if (deck.parameters.coulomb != CoulombSum::direct)
    CHECK(scene.motion->coulomb()->error()->method.starts_with("tree"));
  return arrived;
}

bool run(const Deck& deck, const fs::path& directory, std::function<StopRequest()> stop_request,
         Checkpoint* from = nullptr, int threads = 1) {
  return deck.parameters.system == 1 ? march<1>(deck, directory, std::move(stop_request), from, threads)
                                     : march<3>(deck, directory, std::move(stop_request), from, threads);
}

/// What `treejet run --resume` does.
bool resume(const fs::path& directory, std::function<StopRequest()> stop_request, int threads = 1) {
  Resumption stopped = resumption(directory, this_program);
  return run(stopped.deck, directory, std::move(stop_request), &stopped.checkpoint, threads);
}

/// Stops after so many steps.
std::function<StopRequest()> after(int steps) {
  return [steps]() mutable { return steps-- > 0 ? StopRequest::go_on : StopRequest::stop; };
}

StopRequest never() {
  return StopRequest::go_on;
}

/// All observables but the wall clock's.
constexpr const char* all_keys =
    "t x y z st vx vy vz yz angl n f l curn curc fcn fcc chn chc mfn mfc vn vc svc rc rrr lp rlp nref nmrg";

Case output_often(const char* example, double end, std::vector<std::string> overrides) {
  overrides.push_back(fmt::format("final time {}", end));
  overrides.push_back(fmt::format("print time {}", end / 67));
  overrides.push_back(fmt::format("print xyz {}", end / 31));
  overrides.push_back(fmt::format("print hdf5 {}", end / 23));
  overrides.push_back(fmt::format("printstat list {}", all_keys));
  return {example, overrides};
}

/// Every scheme, both ways of meeting events, one rate and two, direct sum and tree in both orders of points,
/// with insertion and removal inside the time simulated.
std::vector<Case> cases() {
  const std::string near = "collector distance 0.05";
  const std::vector<std::string> long_jet = {"points 1500", "initial length 30.",
                                             "collector distance 30.0001", "coulomb tree",
                                             "coulomb accuracy 1.d-2"};
  auto fixed_tree = long_jet, two_rate_tree = long_jet;
  fixed_tree.insert(fixed_tree.end(), {"coulomb tree space", "integrator 2", "timestep 5.d-8"});
  two_rate_tree.insert(two_rate_tree.end(), {"tolerance 1.d-3"});
  return {
      output_often("pvp", 1e-3, {"points 120", "initial length 2.4", "collector distance 2.45"}),
      output_often("pvp", 2e-3, {near, "integrator dopri5", "multirate no"}),
      output_often("pvp", 2e-3, {near, "integrator verner6", "multirate no"}),
      output_often("pvp", 2e-3, {near, "integrator kencarp5", "elastic modulus 5.d7"}),
      output_often("pvp", 2e-3, {near, "integrator 1", "timestep 5.d-7", "events step"}),
      output_often("pvp", 2e-3, {near, "integrator 2", "timestep 1.d-6"}),
      output_often("pvp", 2e-3,
                   {near, "integrator 3", "timestep 1.d-6", "hbfluid yes", "hbfluid consistency 1.",
                    "hbfluid index 0.8"}),
      output_often("straight-jet", 2e-2, {"collector distance 1."}),
      output_often("pvp", 2e-3,
                   {near, "airdrag yes", "airdrag model full", "airdrag airvelocity -500.", "noise yes",
                    "noise diffusivity 1.d6", "noise variance 1.d4"}),
      output_often("pvp", 2e-3,
                   {near, "system 4", "integrator 4", "timestep 1.d-6", "airdrag amplitude 1.d6"}),
      output_often(
          "pvp", 3e-3,
          {"collector distance 3.", "airdrag yes", "airdrag amplitude 1.d4", "dynamic refinement yes",
           "dynamic refinement every 2.d-4", "dynamic refinement threshold 0.05"}),
      output_often("pvp", 3e-3,
                   {"collector distance 3.", "perturb ampl 1.d-2", "self field slender",
                    "dynamic refinement yes", "dynamic refinement tolerance 1.d-2"}),
      output_often("pvp", 3e-3,
                   {"collector distance 3.", "dynamic refinement yes", "dynamic refinement every 2.d-4",
                    "dynamic refinement threshold 0.05"}),
      output_often("pvp", 2e-3,
                   {"collector distance 1.", "model slender", "flow rate 60 mL/h", "initial length 0.03"}),
      output_often("pvp", 4e-6, fixed_tree),
      output_often("pvp", 2e-4, two_rate_tree)};
}

}  // namespace

TEST_CASE("A run stopped and resumed at any steps leaves the same bytes as one left alone") {
  std::mt19937 random(1);
  for (const Case& c : cases()) {
    const Deck deck = deck_of(c);
    CAPTURE(c.example, c.overrides);
    const ScratchDirectory whole, parts;
    int steps = 0;
    REQUIRE(run(deck, whole.path, [&] { return ++steps, StopRequest::go_on; }));
    REQUIRE(steps > 20);

    std::uniform_int_distribution<int> stop(0, std::max(1, steps / 6));
    int stops = 0;
    bool arrived = run(deck, parts.path, after(stop(random)));
    while (!arrived) arrived = resume(parts.path, after(1 + stop(random)), 1 + ++stops % 3);
    CHECK(stops > 3);
    for (const char* file : {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"})
      CHECK(read_whole(whole.path / file) == read_whole(parts.path / file));
    CHECK_FALSE(fs::exists(parts.path / "checkpoint"));
  }
}

TEST_CASE("Saving a checkpoint between all steps changes no bit and keeps the last two") {
  const Deck deck =
      deck_of({"pvp", {"final time 2.d-4", "print time 3.d-5", "print xyz 7.d-5", "print hdf5 5.d-5"}});
  const ScratchDirectory plain, saving;
  REQUIRE(run(deck, plain.path, never));
  int saved = 0;
  REQUIRE(run(deck, saving.path, [&] {
    if (saved > 1) {
      const double newer = read_checkpoint(saving.path / "checkpoint").t;
      const double older = read_checkpoint(saving.path / "checkpoint.old").t;
      CHECK(newer > older);
    }
    return ++saved, StopRequest::save;
  }));
  CHECK(saved > 20);
  for (const char* file : {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"})
    CHECK(read_whole(plain.path / file) == read_whole(saving.path / file));
  CHECK(std::distance(fs::directory_iterator(saving.path), {}) == 6);  // these, run.json and the last state
}

TEST_CASE("A checkpoint that is not sound is refused, and the older one gives the same bytes") {
  const Deck deck = deck_of({"pvp", {"final time 2.d-4", "print time 3.d-5", "print xyz 7.d-5"}});
  const ScratchDirectory whole, stopped;
  REQUIRE(run(deck, whole.path, never));
  int steps = 0;
  REQUIRE_FALSE(run(deck, stopped.path, [&] {
    ++steps;
    return steps == 10 ? StopRequest::save : steps == 20 ? StopRequest::stop : StopRequest::go_on;
  }));
  const fs::path newest = stopped.path / "checkpoint";
  const std::string sound = read_whole(newest);
  std::string damaged = sound;
  damaged[damaged.size() / 2] ^= 1;
  std::string turned = sound;  // the number behind the title tells the order of bytes
  const auto order = turned.begin() + static_cast<long>(turned.find('\n')) + 1;
  std::reverse(order, order + 8);

  const std::pair<std::string, std::string> unsound[] = {
      {"", "cut short"},
      {sound.substr(0, 10), "cut short"},
      {sound.substr(0, 30), "cut short"},
      {sound.substr(0, sound.size() - 1), "cut short"},
      {damaged, "damaged"},
      {turned, "another byte order"},
      {sound + "x", "damaged"},
      {"treejet checkpoint 999\n" + sound, "another version"},
      {"# t[s] x[cm]\n" + sound, "not a checkpoint"}};
  for (const auto& [bytes, reason] : unsound) {
    overwrite(newest, bytes);
    CHECK_THROWS_WITH(read_checkpoint(newest), Catch::Contains(newest.string()) && Catch::Contains(reason));
    const Resumption older = resumption(stopped.path, this_program);
    REQUIRE(older.warnings.size() == 1);
    CHECK_THAT(older.warnings[0], Catch::Contains(reason));
  }
  CHECK(resume(stopped.path, never));
  for (const char* file : {"statdat.dat", "traj.xyz"})
    CHECK(read_whole(whole.path / file) == read_whole(stopped.path / file));

  fs::remove(stopped.path / "checkpoint.end");
  overwrite(newest, "");
  overwrite(stopped.path / "checkpoint.old", damaged);
  CHECK_THROWS_AS(resumption(stopped.path, this_program), FileError);
  CHECK_THROWS_WITH(resumption(stopped.path, this_program),
                    Catch::Contains("checkpoint.old: damaged") && Catch::Contains("checkpoint: cut short"));
  CHECK(resumption(whole.path, this_program).checkpoint.t > 1.9e-4);
  fs::remove(whole.path / "checkpoint.end");
  CHECK_THROWS_WITH(resumption(whole.path, this_program), Catch::Contains("no checkpoint here"));
}

TEST_CASE("A checkpoint of another program is taken with a warning that names both") {
  const ScratchDirectory place;
  REQUIRE_FALSE(run(deck_of({"pvp", {}}), place.path, after(3)));
  CHECK(resumption(place.path, this_program).warnings.empty());
  const auto warnings = resumption(place.path, "another program").warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains(this_program) && Catch::Contains("another program"));
  // forces of its own are another physics, which is no matter of a warning
  const std::string own = this_program + own_physics_mark + "quadratic drag";
  CHECK_THROWS_WITH(resumption(place.path, own),
                    Catch::Contains("stock physics") && Catch::Contains("quadratic drag"));
}

TEST_CASE("A run goes on only while two of its longest steps still fit into its wall time") {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const double walltime = 0.3;
  const auto begin = Clock::now();
  StopSignals signals({.walltime = walltime});
  double longest = 0;
  for (auto looked = Clock::now(); true;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const auto now = Clock::now();
    // from outside, steps look shorter and the time that is left longer than to what is asked
    longest = std::max(longest, seconds(now - looked));
    const double left = walltime - seconds(now - begin);
    if (signals.stop_request() == StopRequest::stop) break;
    looked = Clock::now();
    REQUIRE(left >= 2 * longest);
  }
  CHECK(signals.reason() == "walltime");
}

TEST_CASE("A deck other than the checkpoint's is refused, naming each directive that differs") {
  const Deck deck = deck_of({"pvp", {}});
  CHECK_NOTHROW(expect_same(deck, deck_of({"pvp", {"final time 0.5", "perturb yes"}})));
  const Deck other = deck_of({"pvp", {"viscosity 30.", "cutoff 2."}});
  CHECK_THROWS_AS(expect_same(other, deck), InputError);
  CHECK_THROWS_WITH(expect_same(other, deck), Catch::Contains("viscosity: 30 here, 20 there") &&
                                                  Catch::Contains("cutoff: 2 here, nothing there") &&
                                                  !Catch::Contains("final time"));
}

TEST_CASE("A stopped run is neither started over nor resumed into files that are not its own") {
  const Deck deck = deck_of({"pvp", {"final time 1.d-3", "print time 3.d-5", "print xyz 7.d-5"}});
  const ScratchDirectory place;
  REQUIRE_FALSE(run(deck, place.path, after(20)));
  CHECK_THROWS_WITH(run(deck, place.path, never), Catch::Contains("--resume"));

  const fs::path rows = place.path / "statdat.dat";
  const std::string all = read_whole(rows);
  overwrite(rows, all.substr(0, all.size() - 1));
  CHECK_THROWS_WITH(resume(place.path, never),
                    Catch::Contains(rows.string()) && Catch::Contains("goes on after"));
  fs::remove(rows);
  CHECK_THROWS_AS(resume(place.path, never), FileError);
  overwrite(rows, all + "1 2 3\n");  // written after the checkpoint, cut off again
  CHECK(resume(place.path, never));
  CHECK_THAT(read_whole(rows), Catch::StartsWith(all) && !Catch::Contains("1 2 3\n"));
}

TEST_CASE("A directory of results takes one run at a time") {
  const ScratchDirectory place;
  const fs::path results = place.path / "results";
  {
    const DirectoryLock first(results);
    CHECK_THROWS_WITH(DirectoryLock(results),
                      Catch::Contains(results.string()) && Catch::Contains("another run"));
  }
  CHECK_NOTHROW(DirectoryLock(results));
  overwrite(place.path / "file", "");
  CHECK_THROWS_AS(DirectoryLock(place.path / "file"), FileError);
}

TEST_CASE("A file of results tells when it is removed or changed") {
  const ScratchDirectory place;
  const fs::path path = place.path / "statdat.dat";
  const auto replace = OutputFile::Existing::replace;
  {
    OutputFile file(path, replace);
    file.write("1\n");
    CHECK_THROWS_WITH(OutputFile(path, OutputFile::Existing::keep), Catch::Contains("--force"));
    file.write("2\n");
    CHECK(read_whole(path) == "1\n2\n");
    fs::remove(path);
    CHECK_THROWS_WITH(file.write("3\n"), Catch::Contains(path.string()) && Catch::Contains("removed"));
  }
  OutputFile file(path, replace);
  file.write("1\n");
  overwrite(path, "");
  CHECK_THROWS_WITH(file.write("2\n"), Catch::Contains("changed by another program"));
  CHECK_THROWS_WITH(file.sync(), Catch::Contains("changed by another program"));
}

TEST_CASE("What an archive reads is what was written; another layout and missing bytes are noticed") {
  struct All {
    double number = 0;
    std::string text;
    std::vector<int> list;
    std::optional<Vec<3>> there, missing = Vec<3>::Zero();
    std::array<State<1>, 2> tables;
    std::vector<std::string> words;
    void visit(Archive& state) { state(number, text, list, there, missing, tables, words); }
  };
  All written{0.1, "x\0y", {1, 2, 3}, Vec<3>(1, 2, 3), std::nullopt, {State<1>::Random(4, 3), {}}, {"", "a"}};
  const std::string bytes = Archive::bytes_of(written);

  All read;
  Archive in(bytes);
  in(read);
  in.expect_end();
  CHECK(read.number == written.number);
  CHECK(read.text == written.text);
  CHECK(read.list == written.list);
  CHECK(*read.there == *written.there);
  CHECK_FALSE(read.missing);
  CHECK((read.tables[0] == written.tables[0]).all());
  CHECK(read.tables[1].rows() == 0);
  CHECK(read.words == written.words);

  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string cut = bytes.substr(0, length);
    Archive archive(cut);
    CHECK_THROWS_AS(archive(read), FileError);
  }
  Archive other(bytes);
  int number = 0;
  CHECK_THROWS_AS(other(number), FileError);
  Archive partly(bytes);
  partly(read.number);
  CHECK_THROWS_AS(partly.expect_end(), FileError);

  // a length that no memory holds
  std::size_t count = std::size_t{1} << 61;
  const std::string wrong = Archive::bytes_of(count);
  Archive of_a_list(wrong);
  CHECK_THROWS_AS(of_a_list(read.list), FileError);
}

TEST_CASE("A row that a full disk has cut short is taken back") {
  const ScratchDirectory place;
  const fs::path path = place.path / "statdat.dat";
  OutputFile file(path, OutputFile::Existing::replace);
  file.write("whole\n");
  struct Limit {
    rlimit before{};
    void (*handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
    explicit Limit(rlim_t bytes) {
      getrlimit(RLIMIT_FSIZE, &before);
      const rlimit now{bytes, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &now);
    }
    ~Limit() {
      setrlimit(RLIMIT_FSIZE, &before);
      std::signal(SIGXFSZ, handler);
    }
  };
  {
    const Limit limit(9);  // three letters of the next row go through
    CHECK_THROWS_WITH(file.write("half a row\n"), Catch::Contains("statdat.dat: writing failed"));
  }
  CHECK(read_whole(path) == "whole\n");
  file.write("next\n");
  CHECK(read_whole(path) == "whole\nnext\n");
}
