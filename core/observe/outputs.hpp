#pragma once
/// The watchers that a deck asks for: terminal table, statdat.dat, traj.xyz, traj.h5, progress, and warnings
/// should approximate forces or fixed steps miss their accuracy or the jet be an absurd one. What it does not
/// ask for is not made: no file, no array. Beside any files of a run stands the record of it, run.json.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/output_file.hpp"
#include "core/base/row_sharing.hpp"
#include "core/io/run_record.hpp"
#include "core/jet/columns.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/observer.hpp"
#include "core/jet/parameters.hpp"
#include "core/observe/own_observable.hpp"

namespace treejet {

template <int D>
class Nozzle;
class Collector;
struct FieldErrorReport;
template <int D>
class XyzTrajectory;
class H5mdTrajectory;
class SteadyMeans;
template <int D>
class StepErrors;
class CheckpointParts;

struct OutputSetting {
  std::filesystem::path directory;
  OutputFile::Existing existing = OutputFile::Existing::keep;
  bool quiet = false;
  bool elsewhere = false;  ///< another process makes the outputs of this run
  Provenance made_by = {};
  Circumstances circumstances = {};
  const FieldErrorReport* force_error = nullptr;  ///< null: exact forces
  Columns added = {};                             ///< of the scene, for frames
  const CheckpointParts* resumed = nullptr;       ///< what to go on from, null for a new run
  RowSharing chunks_shared = all_at_once;         ///< who compresses traj.h5
  std::vector<std::string> changes = {};          ///< directives of a deck that has changed since then
};

template <int D>
class Outputs {
 public:
  /// Opens the files; FileError if one exists already or cannot be made, and then none has been made.
  Outputs(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
          const OutputSetting& setting, const Decomposition<D>& decomposition = undivided<D>,
          const OwnObservables<D>& own = {});
  ~Outputs();

  std::vector<Observer<D>*> observers() const;
  /// One line a file, for the closing summary.
  std::vector<std::string> summary() const;

  void visit(CheckpointParts& state);

  /// The run has come to its end: its means are added, and the record is closed.
  void complete(RunResults results);

  bool makes_files() const { return !files_.empty(); }

 private:
  void contribute(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                  const OutputSetting& setting, const Decomposition<D>& decomposition);
  template <class Samples>
  Samples& watch(const std::string& name, std::unique_ptr<Samples> watcher,
                 const Decomposition<D>& decomposition);
  std::shared_ptr<H5mdTrajectory> trajectory_file(const Parameters& p, const OutputSetting& setting,
                                                  const OwnObservables<D>& own);
  void keep_record(const OutputSetting& setting);
  void look_for_trouble(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                        const Decomposition<D>& decomposition);

  struct Named {
    std::string name;  ///< of the part of a checkpoint that tells its state; empty: it remembers nothing
    std::unique_ptr<Observer<D>> watcher;
  };

  std::vector<Named> watchers_;
  std::vector<std::filesystem::path> files_;
  std::unique_ptr<RunRecord> record_;
  std::shared_ptr<SteadyMeans> means_;
  const StepErrors<D>* step_errors_ = nullptr;  ///< of fixed steps
  const XyzTrajectory<D>* trajectory_ = nullptr;
  bool contributes_ = false;  ///< to the outputs of another process
  int maxnum_;
  const FieldErrorReport* force_error_;
};

}  // namespace treejet
