#pragma once
/// A run in memory: a deck's parameters composed, marched and looked at as the front door does it, without
/// files.

#include <string>
#include <vector>

#include "core/observe/recorder.hpp"
#include "core/observe/sampling.hpp"
#include "forces/scene/scene.hpp"
#include "integrators/run/integration.hpp"
#include "validation/support/example.hpp"

namespace treejet {

/// The same run by steps of `seconds`; for the pairs too, which a deck would give a tolerance.
inline Parameters with_steps(Parameters p, Scheme scheme, double seconds) {
  p.integrator = scheme;
  p.timestep = seconds;
  p.tolerance.reset();
  return p;
}

/// The same run by error control, every term evaluated at every stage.
inline Parameters with_tolerance(Parameters p, double tolerance, Scheme scheme = Scheme::automatic) {
  p.integrator = scheme;
  p.tolerance = tolerance;
  p.multirate = Multirate::no;
  p.timestep.reset();
  return p;
}

template <int D>
struct Run {
  explicit Run(const Parameters& p, Threads threads = {1}, const Ranks& ranks = {})
      : parameters(p), unit(scales(p)), scene(compose<D>(p, threads, ranks)) {}

  /// On to t seconds.
  Effort to(double seconds, std::vector<Observer<D>*> observers = {}) {
    Integration<D> integration(parameters, system(scene), std::move(observers));
    integration.march.to(seconds / unit.time);
    return integration.march.effort();
  }

  const Jet<D>& jet() const { return scene.jet; }
  double x() const { return jet().y(0, 0) * unit.length; }  ///< of the farthest bead, cm
  double yz() const { return position<D>(jet().y, 0).template tail<D - 1>().norm() * unit.length; }  ///< cm
  Eigen::Index beads() const { return jet().size() + jet().held; }

  Parameters parameters;
  Scales unit;
  Scene<D> scene;
};

/// Keeps the whole jet at k * interval, k = 0, 1, 2, ...; interval scaled.
template <int D>
struct Snapshots final : Sampling<D> {
  using Sampling<D>::Sampling;
  void sample(const Jet<D>& jet) override { jets.push_back(whole<D>(this->decomposition(), jet)); }
  std::vector<Jet<D>> jets;
};

/// Rows of observables every `window` seconds of a run to `end`, as statdat.dat has them.
template <int D>
std::vector<std::vector<double>> recorded(Run<D>& run, const std::vector<std::string>& keys, double window,
                                          double end, std::vector<Observer<D>*> others = {}) {
  struct Keep final : RowSink {
    explicit Keep(std::vector<std::vector<double>>& to) : rows(to) {}
    void row(const std::vector<double>& values) override { rows.push_back(values); }
    std::vector<std::vector<double>>& rows;
  };
  const Parameters& p = run.parameters;
  std::vector<std::vector<double>> rows;
  auto setting = Recorder<D>::setting(p, run.scene.nozzle, run.scene.collector, run.scene.force_error(),
                                      run.scene.columns);
  setting.interval = window / run.unit.time;
  setting.end = end / run.unit.time;
  Recorder<D> recorder(setting);
  recorder.add(keys, std::make_unique<Keep>(rows));
  others.push_back(&recorder);
  run.to(end, others);
  return rows;
}

/// log2 of the ratios of successive errors: the order of what made them with a step halved each time.
inline std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> p;
  for (std::size_t k = 1; k < errors.size(); ++k) p.push_back(std::log2(errors[k - 1] / errors[k]));
  return p;
}

}  // namespace treejet
