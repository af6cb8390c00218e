#pragma once
/// Approximate forces that miss the accuracy asked for: a warning on stderr the first time, and what the
/// closing summary says.

#include <string>

#include "core/base/field_error_report.hpp"
#include "core/jet/observer.hpp"

namespace treejet {

/// "forces: tree of order 5, ...; error on sampled beads at the most 3e-06 of the mean field (asked for
/// 1e-05), of a bead 2e-05; 99 in 100 beads below 2.1e-05 of their own field; 12 samples".
std::string summary_of(const FieldErrorReport& forces);

/// Written to stderr; `t` in s.
void warn_of_missed_accuracy(const FieldErrorReport& forces, double t);

template <int D>
class AccuracyWarning final : public Observer<D> {
 public:
  AccuracyWarning(const FieldErrorReport& forces, double time_unit)
      : forces_(forces), time_unit_(time_unit) {}

  void segment(const Jet<D>&, const DenseOutput<D>& segment) override {
    if (warned_ || forces_.missed == 0) return;
    warned_ = true;
    warn_of_missed_accuracy(forces_, segment.until * time_unit_);
  }
  void visit(Archive& state) override { state(warned_); }

 private:
  const FieldErrorReport& forces_;
  double time_unit_;
  bool warned_ = false;
};

}  // namespace treejet
