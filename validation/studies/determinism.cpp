/// The files of a run on ranks and threads, byte by byte against those of one rank with one thread.

#include <fmt/format.h>

#include <cstdlib>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/io/atomic_file.hpp"
#include "validation/support/installation.hpp"
#include "validation/support/rank_layout.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;

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

std::vector<RankLayout> teams(bool quick) {
  if (mpi_launcher().empty()) return {{1, 2}, {1, 4}};
  if (quick) return {{1, 4}, {2, 1}, {3, 2}};
  std::vector<RankLayout> all;
  for (const int ranks : {1, 2, 3, 5})
    for (const int threads : {1, 2, 4})
      if (ranks * threads > 1) all.push_back({ranks, threads});
  return all;
}

void run(const Scene& scene, const RankLayout& layout, const fs::path& results) {
  std::string arguments =
      fmt::format("run {} --quiet --force --out {}",
                  for_shell(source_tree() + "/validation/decks/stream.dat"), for_shell(results.string()));
  for (const auto& d : scene.directives) arguments += " --set " + for_shell(d);
  const std::string line = launch_line(layout, /*pinned*/ false, program_path(), arguments) + " 2>/dev/null";
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
    for (const RankLayout& layout : teams(report.quick)) {
      run(scene, layout, many);
      std::int64_t bytes = 0, differing = 0;
      for (const char* file : {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"}) {
        const auto expected = read_whole(one / file);
        bytes += std::int64_t(expected.size());
        differing += read_whole(many / file) != expected;
      }
      table.row({scene.name, std::int64_t{layout.ranks}, std::int64_t{layout.threads}, bytes, differing});
      all_differing += differing;
    }
  }
  report.check("files that differ", double(all_differing), 0, 0);
  if (all_differing == 0) fs::remove_all(report.directory() / "determinism");
}

}  // namespace treejet
