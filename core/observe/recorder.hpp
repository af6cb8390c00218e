#pragma once
/// Rows of observables at every `print time`, and one where a run ends because all beads have left: the
/// terminal table and statdat.dat.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/observe/observables.hpp"
#include "core/observe/own_observable.hpp"
#include "core/observe/sampling.hpp"

namespace treejet {

/// Takes the rows of a list of keys, and remarks on the rows that follow.
class RowSink {
 public:
  virtual ~RowSink() = default;
  virtual void row(const std::vector<double>& values) = 0;
  virtual void finish() {}
  virtual void visit(Archive&) {}
  virtual void remark(const std::string&) {}
};

template <int D>
class Recorder final : public Sampling<D> {
 public:
  struct Setting {
    const Nozzle<D>& nozzle;
    const Collector& collector;
    Scales scales;
    double nozzle_radius, collector_distance;       ///< cm
    double interval, end;                           ///< scaled
    const FieldErrorReport* force_error = nullptr;  ///< null: exact forces
    Material material = {};
  };

  /// What a deck asks for, of a scene with these columns in its state.
  static Setting setting(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                         const FieldErrorReport* force_error, const Columns& added);

  explicit Recorder(const Setting& setting);

  /// Sends the keys' values, and behind them a caller's own, to the sink at every row. Without a sink the
  /// keys are only followed.
  void add(const std::vector<std::string>& keys, std::shared_ptr<RowSink> sink,
           const OwnObservables<D>& own = {});

  void start(const Jet<D>& jet) override;
  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override;
  void event(EventKind kind, const Jet<D>& jet) override { statistics_.event(kind, jet); }
  void refined(const Jet<D>&, const Refinement& refinement) override { statistics_.refined(refinement); }
  void finish(const Jet<D>& jet) override;
  void visit(Archive& state) override;

 protected:
  void sample(const Jet<D>& jet) override;
  void before_sample(const Jet<D>&, const DenseOutput<D>& segment, double t) override {
    statistics_.integrate(segment, t, this->decomposition());
  }

 private:
  struct List {
    std::vector<Observable<D>> observables;
    std::shared_ptr<RowSink> sink;
  };
  using Clock = std::chrono::steady_clock;

  Timing timing(double t) const;
  double mean_path(const Jet<D>& jet) const;
  void remark_on_forces(const Jet<D>& jet);

  Setting setting_;
  Statistics<D> statistics_;
  std::vector<List> lists_;
  double fed_ = 0, landed_ = 0;
  std::string remarked_;  ///< how the forces of the last row were computed
  Clock::time_point started_, last_row_;
};

}  // namespace treejet
