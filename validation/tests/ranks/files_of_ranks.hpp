#pragma once
/// Runs with files that ranks make together: a directory they share, a deck in subdomains, stop and resume.

#include <fmt/format.h>

#include <fstream>

#include "core/io/atomic_file.hpp"
#include "core/restart/origin.hpp"
#include "core/restart/resume.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/support/scratch_directory.hpp"
#include "validation/tests/ranks/ranked.hpp"

namespace treejet {

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
  std::optional<ScratchDirectory> own;
  std::filesystem::path path;
};

/// A stream of beads, all of whose files are asked for.
inline Deck deck(int points, std::vector<std::string> more) {
  more.insert(more.end(), {"perturb ampl 1.d-3", fmt::format("points {}", points), "print xyz 7.d-5",
                           "print hdf5 9.d-5", "print xyz maxnum 50", "parallel distributed", "coulomb tree",
                           "printstat list t x n f l yz st vx vc rc curn fcn fcc lp rlp"});
  return read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat", more);
}

inline constexpr const char* files[] = {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"};

/// A jet of some sixty beads through insertions, removals and new cuts.
inline Deck short_jet(const char* rates = "multirate no") {
  return deck(60,
              {"final time 5.d-4", "print time 2.5d-5", "tolerance 1.d-6", rates, "coulomb accuracy 1.d-5"});
}
inline Deck two_rates() {
  return short_jet("multirate auto");
}

/// One whose subdomains see each other through a tree, in an order of points that is kept over evaluations.
inline Deck tree_in_space() {
  return deck(900, {"final time 2.d-5", "print time 3.d-6", "timestep 1.d-6", "integrator heun",
                    "coulomb accuracy 1.d-4", "coulomb tree space"});
}

/// One whose elements are split on the way, at two rates for a while.
inline Deck refined_jet() {
  return read_deck(
      TREEJET_SOURCE_DIR "/examples/pvp/input.dat",
      {"points 60", "initial length 1.2", "collector distance 1.25", "nozzle velocity 20.",
       "final time 3.d-4", "print time 1.5d-5", "print xyz 7.d-5", "print hdf5 9.d-5",
       "dynamic refinement yes", "dynamic refinement threshold 0.045", "parallel distributed", "coulomb tree",
       "coulomb accuracy 1.d-5", "printstat list t x n f l nref nmrg yz st vx vc rc lp"});
}

/// Without the lines that tell what made them.
inline std::string content(const std::filesystem::path& file) {
  const std::string all = read_whole(file);
  if (file.extension() != ".dat") return all;
  std::istringstream lines(all);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("##")) kept += line + "\n";
  return kept;
}

inline bool same_files(const std::filesystem::path& a, const std::filesystem::path& b) {
  for (const char* file : files)
    if (content(a / file) != content(b / file)) return false;
  return true;
}

/// All numbers of two tables, or those of the first columns, against the largest of their column.
inline double difference(const std::filesystem::path& a, const std::filesystem::path& b,
                         std::size_t columns = 1000) {
  const auto rows = [](const std::filesystem::path& file) {
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

struct Ended {
  bool arrived = false;
  std::int64_t steps = 0;
};

/// What a run begins with but for its deck.
struct Start {
  Checkpoint* resumed = nullptr;
  std::vector<std::string> changes = {};
  Origin* origin = nullptr;
  Provenance made_by = {};
};

/// On from a checkpoint, another run's state or the start, for so many steps at the most.
inline Ended run(const Deck& deck, const std::filesystem::path& directory, const Ranks& ranks,
                 std::int64_t steps = 1'000'000'000, const Start& from = {}) {
  const Parameters& p = deck.parameters;
  Scene<3> scene = compose<3>(p, {1}, ranks);
  if (from.origin) scene.decomposition().take(scene.jet, jet_of<3>(*from.origin, p, scene.columns));
  OutputSetting outputs{directory};
  outputs.quiet = true;
  outputs.elsewhere = !ranks.first();
  outputs.made_by = from.made_by;
  outputs.force_error = scene.force_error();
  outputs.changes = from.changes;
  Ended ended;
  const auto stop = [&] { return ended.steps++ < steps ? StopRequest::go_on : StopRequest::stop; };
  Simulation<3> simulation(
      deck, system(scene),
      {outputs, stop, from.resumed, {}, from.origin ? steps_of(*from.origin, p) : nullptr});
  ended.arrived = simulation.finish();
  ranks.greatest(0);  // the first rank has written
  return ended;
}

inline Readers readers(const Ranks& ranks) {
  return {ranks.rank(), ranks.size(), [ranks](bool sound) { return ranks.greatest(sound ? 0 : 1) == 0; }};
}

/// With overrides: to a later end.
inline Ended resume(const std::filesystem::path& directory, const Ranks& ranks,
                    std::int64_t steps = 1'000'000'000, const std::vector<std::string>& overrides = {}) {
  Resumption stopped = resumption(directory, program({}), overrides, readers(ranks));
  return run(stopped.deck, directory, ranks, steps, {&stopped.checkpoint, overrides});
}

/// What the first rank finds, to all.
inline double of_first(const Ranks& ranks, const std::function<double()>& find) {
  double found = ranks.first() ? find() : 0;
  ranks.sum({&found, 1});
  return found;
}

}  // namespace treejet
