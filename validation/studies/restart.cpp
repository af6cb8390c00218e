#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "core/base/error.hpp"
#include "core/commands/file_info.hpp"
#include "core/io/atomic_file.hpp"
#include "validation/support/installation.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Scene {
  const char* name;
  const char* example;
  std::vector<std::string> overrides;
};

/// Two rates (which begin at 44 beads), a straight jet, a stiff scheme, a tree: each of a few tenths of a
/// second, with insertion and removal.
const Scene scenes[] = {
    {"two rates", "pvp", {"final time 4.d-2", "print time 1.d-4", "print xyz 1.d-3", "print hdf5 1.d-3"}},
    {"straight jet",
     "straight-jet",
     {"final time 1.", "print time 1.d-3", "print xyz 1.d-2", "print hdf5 1.d-2", "collector distance 5.",
      "printstat list t x st vx n rc curc vc mfc"}},
    {"stiff",
     "pvp",
     {"final time 6.d-2", "print time 1.d-4", "print xyz 1.d-4", "print hdf5 1.d-4", "elastic modulus 5.d7",
      "collector distance 0.1"}},
    {"tree",
     "pvp",
     {"final time 2.d-3", "print time 1.d-5", "print xyz 1.d-4", "print hdf5 1.d-4", "points 1500",
      "initial length 30.", "collector distance 30.0001", "tolerance 1.d-3", "coulomb auto",
      "coulomb accuracy 1.d-2"}}};

/// Those of lines grow at their ends; traj.h5 gets its final form when all is done.
const char* const files[] = {"statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"};
constexpr std::size_t files_of_lines = 2;

/// treejet run, quietly, in a process of its own.
pid_t started(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program_path(), "run", "--quiet"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(argv[0], argv.data());
    _exit(127);
  }
  if (child < 0) throw FileError("no process can be started");
  return child;
}

/// Waits for the end, or brings it about once so many seconds have passed. The exit code; -1 if killed.
int ended(pid_t child, double seconds) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() >= deadline) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Tally {
  std::int64_t kills = 0, unresumable = 0, cut_records = 0, completed = 0;
  std::int64_t astray = 0;      ///< files after a kill that are not a beginning of the whole run's
  std::int64_t unreadable = 0;  ///< traj.h5 or traj.xdmf after a kill
  std::int64_t differing = 0;   ///< files of a completed run that differ from the whole run's
  std::int64_t failures = 0;    ///< exits by itself with anything but 0
};

class Trial {
 public:
  Trial(const Scene& scene, const fs::path& directory) : directory_(directory / "killed") {
    deck_ = {fmt::format("{}/examples/{}/input.dat", source_tree(), scene.example)};
    for (const auto& line : scene.overrides) deck_.insert(deck_.end(), {"--set", line});
    deck_.insert(deck_.end(), {"--set", "checkpoint 0.02"});
    const auto begin = Clock::now();
    const fs::path whole = directory / "whole";
    if (ended(started(with({"--out", whole, "--force", "--threads", "1"})), 600) != 0)
      throw Error(1, "the run that nobody kills fails");
    seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
    for (const char* file : files) whole_.push_back(read_whole(whole / file));
  }

  /// One life after the other, until a run is complete; the last life, after so many kills, is left alone.
  void run(Tally& tally, std::mt19937& random, std::int64_t most_kills) {
    fs::remove_all(directory_);
    while (true) {
      const bool resumable =
          fs::exists(directory_ / "checkpoint") || fs::exists(directory_ / "checkpoint.old");
      const std::string threads = std::to_string(1 + random() % 2);
      const double life =
          tally.kills < most_kills ? std::uniform_real_distribution(0.0, 0.7 * seconds_)(random) : 600;
      const int code =
          ended(resumable ? started({"--resume", directory_, "--threads", threads})
                          : started(with({"--out", directory_, "--force", "--threads", threads})),
                life);
      tally.failures += code > 0;
      if (code >= 0) break;
      ++tally.kills;
      tally.unresumable += !resumable;
      look(tally);
    }
    ++tally.completed;
    for (std::size_t k = 0; k < whole_.size(); ++k)
      tally.differing += read_whole(directory_ / files[k]) != whole_[k];
  }

 private:
  std::vector<std::string> with(std::vector<std::string> further) const {
    further.insert(further.begin(), deck_.begin(), deck_.end());
    return further;
  }

  /// To the last frame; one that is not there yet counts as such.
  static bool readable(const fs::path& file) try {
    std::error_code error;
    return !fs::exists(file, error) || !file_info(file).empty();
  } catch (const Error&) {
    return false;
  }

  void look(Tally& tally) const {
    for (std::size_t k = 0; k < files_of_lines; ++k) {
      const fs::path file = directory_ / files[k];
      const std::string found = fs::exists(file) ? read_whole(file) : "";
      tally.astray += !whole_[k].starts_with(found);
      tally.cut_records += !found.empty() && found.back() != '\n';
    }
    for (std::size_t k = files_of_lines; k < whole_.size(); ++k)
      tally.unreadable += !readable(directory_ / files[k]);
  }

  fs::path directory_;
  std::vector<std::string> deck_, whole_;
  double seconds_ = 0;
};

}  // namespace

void study_restart(Report& report) {
  report.section({"Killed and resumed",
                  "Runs killed (SIGKILL) at random moments: what is left can be read, and the resumed run "
                  "ends with the bytes of one that nobody killed.",
                  "treejet-validate restart --out DIR"});
  const int wanted = report.quick ? 4 : 60;  // kills of a scene
  auto table =
      report.table("restart", "Runs killed (SIGKILL) at random moments and resumed on 1 or 2 threads",
                   {"scene", "kills", "before a checkpoint", "cut records", "completed", "differing files"});
  std::mt19937 random(std::random_device{}());
  Tally all;
  for (const Scene& scene : scenes) {
    Trial trial(scene, report.directory() / "restart");
    Tally tally;
    while (tally.kills < wanted) trial.run(tally, random, wanted);
    table.row({std::string(scene.name), tally.kills, tally.unresumable, tally.cut_records, tally.completed,
               tally.differing});
    all.kills += tally.kills;
    all.astray += tally.astray;
    all.unreadable += tally.unreadable;
    all.differing += tally.differing;
    all.failures += tally.failures;
  }
  if (all.astray + all.unreadable + all.differing + all.failures == 0)
    fs::remove_all(report.directory() / "restart");
  report.check("kills at random moments", double(all.kills), report.quick ? 16 : 200, 1e9);
  report.check("files that after a kill are no beginning of an uninterrupted run's", double(all.astray), 0,
               0);
  report.check("trajectories that after a kill cannot be read", double(all.unreadable), 0, 0);
  report.check("files of resumed runs that differ from an uninterrupted run's", double(all.differing), 0, 0);
  report.check("runs that fail by themselves", double(all.failures), 0, 0);
}

}  // namespace treejet
