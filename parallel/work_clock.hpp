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
/// `steps`. Without a clock a scope looks at one pointer; with one it reads the system's clock twice, 50 to
/// 120 ns, or leaves that to a thread that looks now and then (sampled_work.hpp), as in a run. No result
/// depends on it.

#include <array>
#include <atomic>
#include <chrono>

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
  /// Who reads the time: each scope, or somebody else who looks what is being done (sampled_work.hpp).
  enum class Reading { by_scopes, by_others };

  explicit WorkClock(Reading reading = Reading::by_scopes)
      : reads_(reading == Reading::by_scopes), outer_(running_) {
    running_ = this;
  }
  ~WorkClock() { running_ = outer_; }
  WorkClock(const WorkClock&) = delete;
  WorkClock& operator=(const WorkClock&) = delete;

  /// Whether one is told of what this thread does.
  static bool told() { return running_ != nullptr; }

  /// What is done now; may be asked by other threads.
  Work now() const { return work_.load(std::memory_order_relaxed); }

  /// So far, if scopes read the time.
  WorkSeconds seconds() const {
    WorkSeconds all = seconds_;
    all[static_cast<std::size_t>(now())] += since(Clock::now());
    return all;
  }

 private:
  friend class Working;
  using Clock = std::chrono::steady_clock;

  double since(Clock::time_point now) const { return std::chrono::duration<double>(now - last_).count(); }
  /// Returns what was done before.
  Work turn_to(Work work) {
    const Work before = now();
    if (reads_) {
      const Clock::time_point now = Clock::now();
      seconds_[static_cast<std::size_t>(before)] += since(now);
      last_ = now;
    }
    work_.store(work, std::memory_order_relaxed);
    return before;
  }

  static constinit inline thread_local WorkClock* running_ = nullptr;
  bool reads_;
  WorkClock* outer_;
  WorkSeconds seconds_{};
  std::atomic<Work> work_ = Work::steps;
  Clock::time_point last_ = Clock::now();
};

/// So many points or beads take a hundred times as long as it takes to tell of them.
constexpr int points_worth_telling = 16;

/// A scope in which this is done.
class Working {
 public:
  /// What is not worth telling counts for the scope around it.
  explicit Working(Work work, bool worth_telling = true)
      : clock_(worth_telling ? WorkClock::running_ : nullptr) {
    if (clock_ && clock_->now() == Work::tuning) clock_ = nullptr;
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
