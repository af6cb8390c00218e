#pragma once
/// A simulation: the scheme, step control and outputs that a deck's parameters ask for, and the march of a
/// composed scene through them to the deck's final time.

#include <memory>
#include <string>

#include "core/outputs.hpp"
#include "integrators/march.hpp"

namespace treejet {

template <int D>
class Simulation {
 public:
  /// What moves, and between which ends; it outlives the simulation.
  struct Scene {
    Jet<D>& jet;
    Motion<D>& motion;
    const Nozzle<D>& nozzle;
    const Collector& collector;
  };

  /// Opens the files; FileError if one exists already or cannot be made.
  Simulation(const Parameters& p, const Scene& scene, const OutputSetting& setting);

  void finish();

  /// What `finish` did: time, beads, effort, files.
  std::string summary() const;

 private:
  const Jet<D>& jet_;
  std::unique_ptr<Stepper<D>> stepper_;
  std::unique_ptr<StepControl> control_;
  Outputs<D> outputs_;
  March<D> march_;
  double end_;          ///< scaled
  double seconds_ = 0;  ///< wall clock
};

}  // namespace treejet
