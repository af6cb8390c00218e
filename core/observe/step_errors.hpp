#pragma once
/// What a fixed step costs in accuracy, measured while the run goes on, from what its steps have found
/// anyway.
///
/// Step error: over two equal steps h the change of the state must be the integral of its rate, here by
/// Simpson's rule over the three slopes,
///
///     d = y_2 - y_0 - h/3 (f_0 + 4 f_1 + f_2) ,
///
/// relative to the change itself, of the positions, velocities and stresses of all beads each in the mean
/// square; the largest of the three counts. It is of the order of the scheme in h: of Euler's and Heun's
/// scheme the relative error of a step, of the fourth-order scheme a third to the double of it, for the rule
/// errs by as much. Two steps a sample, one sample in `steps_a_sample` steps; not over events and kinks.
///
/// Lateness: events seen at the ends of steps come late, by overdue length over speed. Over the interval of
/// events this is the error of the flow rate; of removals that of the time of arrival. Located events are
/// never late.
///
/// A mean above 1e-3 is warned of, once. Of a chain held in subdomains all ranks
/// add up what they have of it. A sample that a checkpoint cuts there is lost. Scaled.

#include <string>
#include <utility>
#include <vector>

#include "core/jet/collector.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/observer.hpp"

namespace treejet {

/// How late events of one kind have been.
struct Lateness {
  double sum = 0, first = 0, last = 0;
  std::int64_t count = 0;

  void add(double t, double late);
  /// In the mean, of the mean interval; 0 before there are two.
  double relative() const;
  void visit(Archive& state) { state(sum, first, last, count); }
};

template <int D>
class StepErrors final : public Observer<D> {
 public:
  /// `silent`: it only adds its part to what another rank tells.
  StepErrors(const Nozzle<D>& nozzle, const Collector& collector, EventRule events, double time_unit,
             const Decomposition<D>& all = undivided<D>, bool silent = false)
      : nozzle_(nozzle),
        collector_(collector),
        events_(events),
        time_unit_(time_unit),
        all_(all),
        silent_(silent) {}

  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override;
  void finish(const Jet<D>& jet) override { warn_if_large(jet.t); }
  void visit(Archive& state) override;

  /// In the mean of the samples, 0 without any.
  double step_error() const;
  /// The greater one of insertion and removal.
  double lateness() const;
  std::int64_t samples() const { return samples_; }

  /// "fixed step: ...", for the closing summary.
  std::string summary() const;
  /// For run.json.
  std::vector<std::pair<std::string, double>> results() const;

 private:
  static constexpr int steps_a_sample = 16;

  void see_steps(const DenseOutput<D>& segment);
  bool goes_on(const SolutionPoint<D>& from, double h) const;
  double error_of_two_steps(const SolutionPoint<D>& to, double h) const;
  void see_events(const Jet<D>& jet, const DenseOutput<D>& segment);
  void warn_if_large(double t);

  const Nozzle<D>& nozzle_;
  const Collector& collector_;
  EventRule events_;
  double time_unit_;
  const Decomposition<D>& all_;
  bool silent_;
  SolutionPoint<D> begin_;  ///< of a sample, empty until it begins
  State<D> middle_slope_;
  double middle_ = 0;
  std::int64_t steps_ = 0, samples_ = 0;
  double sum_ = 0;
  Lateness insertion_, removal_;
  bool warned_ = false;
};

}  // namespace treejet
