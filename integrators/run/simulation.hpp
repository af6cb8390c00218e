#pragma once
/// A simulation: the integration of a composed scene to the deck's final time, with the outputs that the deck
/// asks for and checkpoints on the way.
///
/// Whether to save or to stop is asked between any two steps. A simulation stopped and resumed,
/// however often, takes the same steps and leaves the same files, to the bit, as one that was left alone.

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/deck/deck.hpp"
#include "core/io/directory_lock.hpp"
#include "core/observe/outputs.hpp"
#include "core/restart/checkpoint.hpp"
#include "core/restart/stop_request.hpp"
#include "integrators/run/integration.hpp"
#include "parallel/ranks.hpp"
#include "parallel/work_clock.hpp"

namespace treejet {

template <int D>
class Simulation {
 public:
  struct Setting {
    OutputSetting outputs;
    std::function<StopRequest()> stop_request = [] {
      return StopRequest::go_on;
    };                              ///< asked between any two steps
    Checkpoint* resumed = nullptr;  ///< of the same deck, to continue; null for a new run
    OwnObservables<D> observables = {};
    /// Of another run, whose steps this one goes on with; null where they begin with the system's jet.
    Checkpoint* steps = nullptr;
    std::function<GatherTimes()> gather_times = [] { return GatherTimes(); };  ///< of all ranks together
    /// Numbers of a rank become those of all ranks in the mean.
    std::function<void(std::span<double>)> mean_over_ranks = [](std::span<double>) {};
  };

  /// Opens the files; FileError if one exists already or cannot be made, or cannot be continued.
  Simulation(const Deck& deck, const System<D>& system, const Setting& setting);

  /// On to the final time, or until all beads have left. False if stopped before, with a checkpoint.
  bool finish();

  double t() const;  ///< s
  const Effort& effort() const { return march_.effort(); }

  /// What `finish` did: time, beads, effort, files.
  std::string summary() const;

 private:
  bool march_to_end();
  bool stop_here();
  void save();
  std::string flow_summary() const;
  bool leaves_state() const;
  void keep_state();
  RunResults results() const;
  Checkpoint state();
  void visit(CheckpointParts& state);

  const Deck& deck_;
  double time_unit_;  ///< s
  Jet<D>& jet_;
  const Nozzle<D>& nozzle_;
  Decomposition<D>& decomposition_;
  Setting setting_;
  std::optional<DirectoryLock> lock_;       ///< before anything in the directory is touched
  std::optional<Checkpoints> checkpoints_;  ///< none if another process makes the outputs
  std::optional<Checkpoint> before_end_;    ///< the last state that the final time had no influence on
  bool saved_before_end_ = false;           ///< that one is the newest checkpoint
  Outputs<D> outputs_;
  std::unique_ptr<Observer<D>> watchers_;
  Integration<D> integration_;
  March<D>& march_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point started_ = Clock::now();  ///< as if never stopped
  const Clock::time_point begun_ = Clock::now();
  WorkSeconds work_{};  ///< of `finish`, where it went
};

}  // namespace treejet
