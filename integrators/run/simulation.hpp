#pragma once
/// A simulation: the scheme, step control and outputs that a deck asks for, and the march of a composed scene
/// through them to the deck's final time, with checkpoints on the way.
///
/// Whether it is to be saved or stopped is asked between any two steps. A simulation stopped and resumed,
/// however often, takes the same steps and leaves the same files, to the bit, as one that was left alone.

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "core/deck/deck.hpp"
#include "core/observe/outputs.hpp"
#include "core/restart/checkpoint.hpp"
#include "core/restart/stop_request.hpp"
#include "integrators/march/march.hpp"

namespace treejet {

template <int D>
class Simulation {
 public:
  /// What moves, and between which ends; it outlives the simulation.
  struct Scene {
    Jet<D>& jet;
    RightHandSide<D>& motion;
    const Nozzle<D>& nozzle;
    const Collector& collector;
    Decomposition<D>& decomposition = undivided<D>;
  };

  struct Setting {
    OutputSetting outputs;
    std::function<StopRequest()> stop_request = [] {
      return StopRequest::go_on;
    };                              ///< asked between any two steps
    Checkpoint* resumed = nullptr;  ///< of the same deck, to go on from; null for a new run
  };

  /// Opens the files; FileError if one exists already or cannot be made, or cannot be gone on with.
  Simulation(const Deck& deck, const Scene& scene, const Setting& setting);

  /// On to the final time. False if stopped before, with a checkpoint.
  bool finish();

  double t() const;  ///< s

  /// What `finish` did: time, beads, effort, files.
  std::string summary() const;

 private:
  bool stop_here();
  void visit(CheckpointParts& state);

  const Deck& deck_;
  const Jet<D>& jet_;
  const Decomposition<D>& holding_;
  Setting setting_;
  std::optional<Checkpoints> checkpoints_;  ///< none if another process makes the outputs
  std::unique_ptr<Stepper<D>> stepper_;
  std::unique_ptr<StepControl> control_;
  Outputs<D> outputs_;
  March<D> march_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point started_ = Clock::now();  ///< as if never stopped
};

}  // namespace treejet
