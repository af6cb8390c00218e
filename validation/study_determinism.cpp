/// The files of a run on ranks and threads, byte by byte against those of one rank with one thread.

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "validation/studies.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;

/// 1100 beads, enough for four threads, stream from nozzle to collector; seven are taken away.
const std::vector<std::string> streaming = {
    "final time 3.d-5",          "print time 2.d-6",       "print xyz 2.d-6",
    "print hdf5 4.d-6",          "print xyz maxnum 1200",  "points 1100",
    "initial length 1.",         "nozzle cross 5.d-4",     "nozzle velocity 200.",
    "collector distance 1.0005", "external potential 1.9", "perturb ampl 1.d-4"};

struct Scene {
  std::string name;
  std::vector<std::string> directives;
};

const std::vector<Scene> scenes = {
    {"fixed steps", {"timestep 1.d-6", "integrator heun"}},
    {"two rates", {"tolerance 1.d-6"}},
    {"tree", {"tolerance 1.d-6", "coulomb tree", "coulomb accuracy 1.d-3"}},
    {"tree in space",
     {"tolerance 1.d-6", "multirate no", "coulomb tree space", "coulomb tree", "coulomb accuracy 1.d-3"}}};

struct Team {
  int ranks, threads;
};

std::vector<Team> teams(bool quick) {
  if (!*TREEJET_MPIEXEC) return {{1, 2}, {1, 4}};
  if (quick) return {{1, 4}, {2, 1}, {3, 2}};
  std::vector<Team> all;
  for (const int ranks : {1, 2, 3, 5})
    for (const int threads : {1, 2, 4})
      if (ranks * threads > 1) all.push_back({ranks, threads});
  return all;
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string() + ": was not written");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void run(const Scene& scene, const Team& team, const fs::path& results) {
  std::string line = "OMP_WAIT_POLICY=passive ";
  if (team.ranks > 1)
    line += fmt::format(
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
        "OMPI_MCA_hwloc_base_binding_policy=none '{}' -n {} ",
        TREEJET_MPIEXEC, team.ranks);
  line += fmt::format("'{}' run '{}/examples/pvp/input.dat' --quiet --force --threads {} --out '{}'",
                      TREEJET_PROGRAM, TREEJET_SOURCE_DIR, team.threads, results.string());
  for (const auto* directives : {&streaming, &scene.directives})
    for (const auto& d : *directives) line += fmt::format(" --set '{}'", d);
  line += " 2>/dev/null";
  if (std::system(line.c_str()) != 0) throw Error(1, "failed: " + line);
}

}  // namespace

void study_determinism(Report& report) {
  report.section(
      {"The same bytes on any number of ranks and threads",
       "Runs with insertions and removals on ranks and threads against the same run on one of each: table of "
       "observables and both trajectories.",
       "treejet-validate determinism --out DIR"});
  auto table = report.table("determinism", "Files that differ from those of one rank with one thread",
                            {"scene", "ranks", "threads", "bytes", "differing files"});
  const fs::path one = report.directory() / "determinism" / "one",
                 many = report.directory() / "determinism" / "many";
  std::int64_t all_differing = 0;
  for (const Scene& scene : scenes) {
    run(scene, {1, 1}, one);
    for (const Team& team : teams(report.quick)) {
      run(scene, team, many);
      std::int64_t bytes = 0, differing = 0;
      for (const char* file : {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"}) {
        const auto expected = contents(one / file);
        bytes += std::int64_t(expected.size());
        differing += contents(many / file) != expected;
      }
      table.row({scene.name, std::int64_t{team.ranks}, std::int64_t{team.threads}, bytes, differing});
      all_differing += differing;
    }
  }
  report.check("files that differ", double(all_differing), 0, 0);
  if (all_differing == 0) fs::remove_all(report.directory() / "determinism");
}

}  // namespace treejet
