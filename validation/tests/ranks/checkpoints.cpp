#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/restart/resume.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/support/scratch_directory.hpp"
#include "validation/tests/ranks/ranked.hpp"

using namespace treejet;
namespace fs = std::filesystem;

namespace {

constexpr const char* files[] = {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"};

/// A directory that all ranks know.
struct SharedPlace {
  explicit SharedPlace(const Ranks& ranks) {
    Ranks::Messages messages(index(ranks.size()));
    if (ranks.first()) {
      own.emplace();
      const std::string name = own->path.string();
      for (auto& message : messages) message.assign(name.begin(), name.end());
    }
    const std::vector<double> name = ranks.exchange(messages).front();
    path = std::string(name.begin(), name.end());
  }
  std::optional<Place> own;
  fs::path path;
};

Deck deck(int points, std::vector<std::string> more) {
  more.insert(more.end(), {"perturb ampl 1.d-3", fmt::format("points {}", points), "print xyz 7.d-5",
                           "print hdf5 9.d-5", "print xyz maxnum 50", "parallel distributed", "coulomb tree",
                           "printstat list t x n f l yz st vx vc rc curn fcn fcc lp rlp"});
  return read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat", more);
}

/// A jet of some sixty beads through insertions, removals and new cuts.
Deck short_jet(const char* rates = "multirate no") {
  return deck(60,
              {"final time 5.d-4", "print time 2.5d-5", "tolerance 1.d-6", rates, "coulomb accuracy 1.d-5"});
}
Deck two_rates() {
  return short_jet("multirate auto");
}

/// One whose subdomains see each other through a tree, in an order of points that is kept over evaluations.
Deck tree_in_space() {
  return deck(900, {"final time 2.d-5", "print time 3.d-6", "timestep 1.d-6", "integrator heun",
                    "coulomb accuracy 1.d-4", "coulomb tree space"});
}

struct Ended {
  bool arrived = false;
  std::int64_t steps = 0;
};

/// On from the checkpoint in a directory, or from the start, for so many steps at the most.
Ended run(const Deck& deck, const fs::path& directory, const Ranks& ranks, std::int64_t steps = 1'000'000'000,
          Checkpoint* from = nullptr) {
  Scene<3> scene = compose<3>(deck.parameters, {1}, ranks);
  Ended ended;
  const auto stop = [&] { return ended.steps++ < steps ? StopRequest::go_on : StopRequest::stop; };
  Simulation<3> simulation(
      deck, system(scene),
      {{directory, OutputFile::Existing::keep, true, !ranks.first(), {}, {}, scene.force_error()},
       stop,
       from});
  ended.arrived = simulation.finish();
  ranks.greatest(0);  // the first rank has written
  return ended;
}

Readers readers(const Ranks& ranks) {
  return {ranks.rank(), ranks.size(), [ranks](bool sound) { return ranks.greatest(sound ? 0 : 1) == 0; }};
}

Ended resume(const fs::path& directory, const Ranks& ranks, std::int64_t steps = 1'000'000'000) {
  Resumption stopped = resumption(directory, program({}), {}, readers(ranks));
  return run(stopped.deck, directory, ranks, steps, &stopped.checkpoint);
}

bool same_files(const fs::path& a, const fs::path& b) {
  for (const char* file : files)
    if (read_whole(a / file) != read_whole(b / file)) return false;
  return true;
}

/// All numbers of two tables, or those of the first columns, against the largest of their column.
double difference(const fs::path& a, const fs::path& b, std::size_t columns = 1000) {
  const auto rows = [](const fs::path& file) {
    std::ifstream stream(file / "statdat.dat");
    std::vector<std::vector<double>> all;
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with("#")) continue;
      std::istringstream words(line);
      all.emplace_back();
      for (std::string word; words >> word;) all.back().push_back(std::stod(word));
    }
    return all;
  };
  const auto these = rows(a), those = rows(b);
  if (these.size() != those.size() || these.size() < 3) return 1e300;
  double largest = 0;
  for (std::size_t column = 0; column < std::min(columns, these[0].size()); ++column) {
    double scale = 0, apart = 0;
    for (std::size_t row = 0; row < these.size(); ++row) {
      const double x = these[row][column], y = those[row][column];
      if (std::isnan(x) != std::isnan(y)) return 1e300;
      if (std::isnan(x)) continue;
      scale = std::max(scale, std::abs(x));
      apart = std::max(apart, std::abs(x - y));
    }
    if (apart > 0) largest = std::max(largest, apart / scale);
  }
  return largest;
}

/// What the first rank finds, to all.
double of_first(const Ranks& ranks, const std::function<double()>& find) {
  double found = ranks.first() ? find() : 0;
  ranks.sum({&found, 1});
  return found;
}

}  // namespace

TEST_CASE(
    "A jet in subdomains that is stopped and resumed on as many ranks leaves the bytes of one left alone") {
  const Ranks& ranks = started_ranks();
  for (const Deck& deck : {short_jet(), two_rates(), tree_in_space()}) {
    const SharedPlace whole(ranks), parts(ranks);
    const Ended left_alone = run(deck, whole.path, ranks);
    REQUIRE(left_alone.arrived);
    const std::int64_t stride = left_alone.steps / 4;
    REQUIRE(stride > 2);
    bool arrived = run(deck, parts.path, ranks, stride).arrived;
    int resumed = 0;
    for (; !arrived; ++resumed) arrived = resume(parts.path, ranks, stride + resumed).arrived;
    CHECK(resumed > 2);
    CHECK(of_first(ranks, [&] { return same_files(whole.path, parts.path); }) == 1);
    CHECK(of_first(ranks, [&] { return fs::exists(parts.path / "checkpoint"); }) == 0);
  }
}

TEST_CASE("A jet in subdomains goes on on another number of ranks, to the accuracy of field and steps") {
  const Ranks& ranks = started_ranks();
  // 1e-5 of the field moves observables by less than a tenth of it, as long as the steps are the same; two
  // rates take others where the field is another in its last digits, and tolerance 1e-6 is 1e-5 in x
  const std::vector<std::tuple<Deck, std::size_t, double>> cases = {{short_jet(), 1000, 1e-6},
                                                                    {two_rates(), 5, 1e-5}};
  for (const auto& [deck, columns, apart] : cases) {
    const SharedPlace whole(ranks), parts(ranks);
    const Ended left_alone = run(deck, whole.path, ranks);
    const std::int64_t stride = left_alone.steps / 3;
    CHECK_FALSE(run(deck, parts.path, ranks, stride).arrived);
    // the second third by the first rank alone
    if (ranks.first()) CHECK_FALSE(resume(parts.path, {}, stride).arrived);
    ranks.greatest(0);
    CHECK(resume(parts.path, ranks).arrived);
    const auto between = [&, n = columns] { return difference(whole.path, parts.path, n); };
    CHECK(of_first(ranks, between) < apart);
  }
}

TEST_CASE("A checkpoint of subdomains with a damaged record is passed over by all ranks") {
  const Ranks& ranks = started_ranks();
  const Deck deck = short_jet();
  const SharedPlace whole(ranks), parts(ranks);
  run(deck, whole.path, ranks);
  run(deck, parts.path, ranks, 20);
  resume(parts.path, ranks, 20);
  ranks.greatest(0);
  if (ranks.first()) {
    const auto file = parts.path / "checkpoint";
    std::string bytes = read_whole(file);
    const std::size_t last = bytes.size() - 1;
    // from inside the head to the end, numbers in front of records included
    for (std::size_t at = last % 7 + last / 2; at <= last; at += 7) {
      bytes[at] ^= 1;
      std::ofstream(file, std::ios::binary) << bytes;
      CHECK_THROWS_AS(read_checkpoint(file), FileError);
      if (at + 7 <= last) bytes[at] ^= 1;
    }
  }
  ranks.greatest(0);
  const Resumption older = resumption(parts.path, program({}), {}, readers(ranks));
  CHECK(older.warnings.size() == 1);
  CHECK(older.checkpoint.file == parts.path / "checkpoint.old");
  CHECK(resume(parts.path, ranks).arrived);
  CHECK(of_first(ranks, [&] { return same_files(whole.path, parts.path); }) == 1);
}
