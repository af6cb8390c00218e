/// Short runs, whose files are the seeds of all readers but the deck's.

#include <fmt/format.h>

#include <fstream>

#include "core/commands/convert.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/provenance.hpp"
#include "core/io/run_record.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/scene/scene.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/fuzz/target.hpp"
#include "validation/support/installation.hpp"
#include "validation/support/scratch_directory.hpp"

namespace treejet::fuzz {

namespace fs = std::filesystem;

namespace {

constexpr const char* keys = "t x y z st vx l n curn vc cpu";

struct Kind {
  const char* example;
  std::vector<std::string> overrides;
};

/// One for each of what a state may hold: one dimension and three, two rates, a tree, a column of the scene.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"straight-jet",
       {"collector distance 0.5", "final time 1.d-2", "print time 1.d-3", "print hdf5 1.d-3"}},
      {"pvp",
       {"collector distance 0.05", "final time 2.d-3", "print time 1.d-4", "print hdf5 2.d-4",
        "print xyz 4.d-4"}},
      {"pvp",
       {"collector distance 2.45", "final time 1.d-6", "points 60", "initial length 2.4",
        "coulomb tree space", "dynamic refinement yes", "dynamic refinement tolerance 1.d-2", "integrator 2",
        "timestep 5.d-8", "print hdf5 1.d-6"}},
      {"pvp",
       {"collector distance 0.05", "final time 1.d-3", "evaporation yes", "evaporation polymer frac 0.1",
        "print hdf5 5.d-4"}}};
  return all;
}

template <int D>
void march(const Deck& deck, const fs::path& directory, int steps) {
  Scene<D> scene = compose<D>(deck.parameters, {1});
  const auto stop = [&steps] { return steps-- > 0 ? StopRequest::go_on : StopRequest::stop; };
  OutputSetting outputs{directory, OutputFile::Existing::keep, /*quiet*/ true};
  outputs.made_by = provenance(deck, isa_name());
  outputs.force_error = scene.force_error();
  Simulation<D> simulation(deck, system(scene), {outputs, stop});
  simulation.finish();
}

void run(const Deck& deck, const fs::path& directory, int steps) {
  deck.parameters.system == 1 ? march<1>(deck, directory, steps) : march<3>(deck, directory, steps);
}

/// Runs all kinds, each to its end, stopped half way, and stopped at once; returns their directories.
std::vector<fs::path> runs() {
  static const ScratchDirectory place;
  std::vector<fs::path> directories;
  for (const Kind& kind : kinds()) {
    std::vector<std::string> overrides = kind.overrides;
    overrides.push_back(fmt::format("printstat list {}", keys));
    const Deck deck =
        read_deck(fmt::format("{}/examples/{}/input.dat", source_tree(), kind.example), overrides);
    for (const int steps : {1, 30, 1'000'000}) {
      directories.push_back(place.path / fmt::format("run-{}", directories.size()));
      run(deck, directories.back(), steps);
      for (const char* format : {"csv", "vtp", "extxyz"})
        convert(
            {directories.back() / "traj.h5", format, directories.back() / fmt::format("traj-of.{}", format)});
    }
  }
  return directories;
}

}  // namespace

std::vector<std::string> files_of_runs(std::string_view name) {
  static const std::vector<fs::path> all = runs();
  std::vector<std::string> files;
  for (const fs::path& directory : all)
    if (exists(directory / name)) files.push_back(read_whole(directory / name));
  return files;
}

}  // namespace treejet::fuzz
