#pragma once
/// The watchers that a deck asks for: terminal table, statdat.dat, traj.xyz, traj.h5, progress, and a warning
/// should approximate forces miss their accuracy. What it does not ask for is not made: no file, no array.
/// Beside any files of a run stands the record of it, run.json.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/directory_lock.hpp"
#include "core/holding.hpp"
#include "core/output_file.hpp"
#include "core/parameters.hpp"
#include "core/run_record.hpp"
#include "core/watcher.hpp"

namespace treejet {

template <int D>
class Nozzle;
class Collector;
struct ForceError;
template <int D>
class Trajectory;
class TrajectoryFile;
class State;

struct OutputSetting {
  std::filesystem::path directory;
  OutputFile::Existing existing = OutputFile::Existing::keep;
  bool quiet = false;
  bool elsewhere = false;  ///< another process makes the outputs of this run
  Provenance made_by = {};
  Circumstances circumstances = {};
  const ForceError* force_error = nullptr;  ///< null: exact forces
  const State* resumed = nullptr;           ///< what to go on from, null for a new run
};

template <int D>
class Outputs {
 public:
  /// Opens the files; FileError if one exists already or cannot be made, or if another run writes there.
  Outputs(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
          const OutputSetting& setting, const Holding<D>& holding = held_whole<D>);
  ~Outputs();

  std::vector<Watcher<D>*> watchers() const;
  /// One line a file, for the closing summary.
  std::vector<std::string> summary() const;

  void visit(State& state);

 private:
  void contribute(const Parameters& p, const OutputSetting& setting, const Holding<D>& holding);
  template <class Samples>
  Samples& watch(const std::string& name, std::unique_ptr<Samples> watcher, const Holding<D>& holding);
  std::shared_ptr<TrajectoryFile> trajectory_file(const Parameters& p, const OutputSetting& setting);
  void keep_record(const OutputSetting& setting);

  struct Named {
    std::string name;  ///< of the part of a checkpoint that tells its state
    std::unique_ptr<Watcher<D>> watcher;
  };

  std::optional<DirectoryLock> lock_;  ///< none without files
  std::vector<Named> watchers_;
  std::vector<std::filesystem::path> files_;
  const Trajectory<D>* trajectory_ = nullptr;
  int maxnum_;
  const ForceError* force_error_;
};

}  // namespace treejet
