#pragma once
/// Calls a function where a run begins and at the asked times k * interval after that, exactly there, by
/// dense output. All times scaled.

#include <algorithm>

#include "core/base/multiples.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/observer.hpp"

namespace treejet {

template <int D>
class Sampling : public Observer<D> {
 public:
  explicit Sampling(double interval) : interval_(interval) {}

  /// Of a jet in subdomains all ranks sample together, each its own rows.
  void sample_all(const Decomposition<D>& decomposition) { decomposition_ = &decomposition; }

  /// One more sample, between two asked times, where all beads have left and the run ends there.
  void sample_early_end() { samples_early_end_ = true; }

  void start(const Jet<D>& jet) override {
    count_ = static_cast<std::int64_t>(last_multiple(jet.t, interval_));
    take(jet, jet.t, jet.y);
  }

  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override {
    while (next() < segment.until - slack()) {
      const double t = std::max(next(), segment.begin());
      before_sample(jet, segment, t);
      take(jet, t, t == segment.begin() ? segment.first() : segment.at(t));
    }
  }

  void finish(const Jet<D>& jet) override {
    const bool due = next() <= jet.t + slack(), open = jet.t > next() - interval_ + slack();
    const bool early_end = samples_early_end_ && open && decomposition_->beads(jet) == 0;
    if (due || early_end) take(jet, jet.t, jet.y);
  }

  void visit(Archive& state) override { state(count_); }

 protected:
  /// The jet at an asked time, jet.t, with the state there.
  virtual void sample(const Jet<D>& jet) = 0;
  /// Told just before a sample that falls into a segment.
  virtual void before_sample(const Jet<D>&, const DenseOutput<D>&, double /*t*/) {}

  const Decomposition<D>& decomposition() const { return *decomposition_; }
  double next() const { return interval_ * double(count_); }
  double interval() const { return interval_; }

 private:
  /// The asked times and the grid of the steps round differently.
  double slack() const { return interval_ * multiple_round_off(double(count_)); }

  void take(const Jet<D>& jet, double t, const State<D>& y) {
    sample(at(jet, t, y));
    ++count_;
  }

  const Decomposition<D>* decomposition_ = &undivided<D>;
  bool samples_early_end_ = false;
  double interval_;
  std::int64_t count_ = 0;
};

}  // namespace treejet
