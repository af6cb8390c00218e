#pragma once
/// Where the time of a run goes, without a clock read at each scope: a thread of its own looks now and then
/// what is being done, and counts the time since its last look for that.
///
/// It looks every millisecond at first, later every hundredth of a second: of a kind of work that takes the
/// part p of n looks the part is known to sqrt(p (1 - p) / n). Kinds are those of work_clock.hpp, their sum
/// is the time since the start.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "parallel/work_clock.hpp"

namespace treejet {

class SampledWork {
 public:
  /// From here on, of this thread; nothing is told where another clock is told already, or where there is no
  /// thread to be had.
  SampledWork();
  ~SampledWork();
  SampledWork(const SampledWork&) = delete;
  SampledWork& operator=(const SampledWork&) = delete;

  /// So far.
  WorkSeconds seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  void look();

  std::optional<WorkClock> told_;
  mutable std::mutex counting_;
  std::condition_variable ended_;
  bool over_ = false;
  WorkSeconds seconds_{};
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
  std::thread looks_;
};

}  // namespace treejet
