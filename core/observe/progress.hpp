#pragma once
/// How far a run is and how long it still takes, from its recent speed: one line rewritten in place on an
/// interactive terminal, a plain line every ten seconds elsewhere. Written to stderr.

#include <chrono>
#include <string>

#include "core/jet/decomposition.hpp"
#include "core/jet/observer.hpp"

namespace treejet {

class ProgressLine {
 public:
  ProgressLine(double end_in_seconds, bool interactive);
  /// Shows simulated time (s) and beads if the last line is old enough.
  void show(double t, Eigen::Index beads);
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  double end_;
  bool interactive_;
  Clock::time_point last_ = Clock::now();
  double last_t_ = 0;
};

constexpr const char* clear_line = "\r\033[K";

/// Whether stderr is a terminal.
bool stderr_is_interactive();

/// A warning of a run at time t, s, on a line of its own: "treejet: warning: at t = 0.02 s the ...".
void warn_at(double t, const std::string& what);

/// "42 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

template <int D>
class Progress final : public Observer<D> {
 public:
  Progress(double end, double time_unit, bool interactive, const Decomposition<D>& decomposition)
      : time_unit_(time_unit), line_(end * time_unit, interactive), decomposition_(decomposition) {}

  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override {
    constexpr int steps_a_look = 64;  // a look at the clock costs as much as a step of a single bead
    if (++steps_ % steps_a_look == 0) line_.show(segment.until * time_unit_, decomposition_.beads(jet));
  }
  void finish(const Jet<D>&) override { line_.clear(); }

 private:
  double time_unit_;
  ProgressLine line_;
  const Decomposition<D>& decomposition_;
  std::int64_t steps_ = 0;
};

}  // namespace treejet
