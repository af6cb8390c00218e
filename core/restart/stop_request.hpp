#pragma once
/// Whether a run is to be saved now, or to stop early: asked between any two steps.
///
/// SIGTERM, SIGINT, SIGUSR1, SIGUSR2, SIGHUP and SIGXCPU all stop the run; SIGPIPE does not. SIGUSR1 is what
/// batch systems send ahead of the end (Slurm's
/// --signal); going on until they kill would only lose what is computed after the checkpoint. The wall clock
/// saves `checkpoint` seconds after the end of the last save, the first time before the first step, so that a
/// run can be resumed from any death, and stops the run in time to write the last checkpoint before
/// `walltime` seconds are over.
///
/// The answer depends on clock and signals, so it differs between processes: where several march together,
/// they have to agree on one answer before they follow it.

#include <chrono>
#include <optional>
#include <string>

namespace treejet {

enum class StopRequest { go_on, save, stop };  ///< from weak to strong

class StopSignals {
 public:
  struct Setting {
    std::optional<double> checkpoint = {}, walltime = {};  ///< wall-clock seconds
  };

  /// From here on the signals are caught, and the time counts.
  explicit StopSignals(const Setting& setting);

  StopRequest stop_request();
  /// "SIGTERM", "walltime", "a signal to another process": why the run stops.
  std::string reason() const;

 private:
  using Clock = std::chrono::steady_clock;

  StopRequest look_at_clock();

  Setting setting_;
  Clock::time_point started_ = Clock::now(), last_look_ = started_;
  double next_save_ = 0;          ///< seconds since the start
  bool saving_ = false;           ///< the last look asked for a save
  double longest_ = 0;            ///< between two looks, steps and checkpoints in between
  int stride_ = 1, to_look_ = 1;  ///< steps between looks, and until the next
};

}  // namespace treejet
