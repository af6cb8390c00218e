#pragma once
/// Where the time of a process goes: seconds of each kind of its work, as the thread sees it that does or
/// leads the work.
///
///     const WorkClock clock;                  from here on, of this thread
///     { const Working at(Work::build); ... }  wherever there is something to tell
///     clock.seconds()[int(Work::build)]
///
/// Kinds exclude each other: what a scope inside another is told of does not count for the outer one, so that
/// their sum is the time since the start. `tuning` alone keeps all that is inside it. What no scope names is
/// `steps`. Without a clock, which is the rule, a scope looks at one pointer; with one it reads the system's
/// clock twice, about 40 ns. No result depends on it.

#include <array>
#include <chrono>
#include <utility>

namespace treejet {

enum class Work {
  steps,      ///< of the scheme, events, decisions
  multirate,  ///< fast beads, and the continuation of slow ones in time
  local,      ///< forces between neighbours and from outside
  build,      ///< order of points, cells of the tree
  upward,     ///< moments
  exchange,   ///< messages to and from other ranks, made, sent, waited for, read
  evaluate,   ///< the Coulomb sum, by the tree or direct
  tuning,     ///< the choice of a tree and measurements of its error, exchanges for it included
  output      ///< tables, frames, statistics; checkpoints
};

constexpr std::array work_names = {"steps",    "multirate", "local",  "build", "upward",
                                   "exchange", "evaluate",  "tuning", "output"};

using WorkSeconds = std::array<double, work_names.size()>;

class WorkClock {
 public:
  WorkClock() : outer_(running_) { running_ = this; }
  ~WorkClock() { running_ = outer_; }
  WorkClock(const WorkClock&) = delete;
  WorkClock& operator=(const WorkClock&) = delete;

  /// So far.
  WorkSeconds seconds() const {
    WorkSeconds all = seconds_;
    all[static_cast<std::size_t>(work_)] += since(Clock::now());
    return all;
  }

 private:
  friend class Working;
  using Clock = std::chrono::steady_clock;

  double since(Clock::time_point now) const { return std::chrono::duration<double>(now - last_).count(); }
  /// Returns what was done before.
  Work turn_to(Work work) {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(work_)] += since(now);
    last_ = now;
    return std::exchange(work_, work);
  }

  static constinit inline thread_local WorkClock* running_ = nullptr;
  WorkClock* outer_;
  WorkSeconds seconds_{};
  Work work_ = Work::steps;
  Clock::time_point last_ = Clock::now();
};

/// A scope in which this is done.
class Working {
 public:
  explicit Working(Work work) : clock_(WorkClock::running_) {
    if (clock_ && clock_->work_ == Work::tuning) clock_ = nullptr;
    if (clock_) before_ = clock_->turn_to(work);
  }
  ~Working() {
    if (clock_) clock_->turn_to(before_);
  }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

 private:
  WorkClock* clock_;
  Work before_ = Work::steps;
};

}  // namespace treejet
