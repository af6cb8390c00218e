#include "parallel/sampled_work.hpp"

#include <algorithm>
#include <system_error>

namespace treejet {

SampledWork::SampledWork() {
  if (WorkClock::told()) return;
  told_.emplace(WorkClock::Reading::by_others);
  try {
    looks_ = std::thread([this] { look(); });
  } catch (const std::system_error&) {
    told_.reset();
  }
}

SampledWork::~SampledWork() {
  {
    const std::lock_guard alone(counting_);
    over_ = true;
  }
  ended_.notify_all();
  if (looks_.joinable()) looks_.join();
}

WorkSeconds SampledWork::seconds() const {
  const std::lock_guard alone(counting_);
  WorkSeconds all = seconds_;
  if (told_)
    all[static_cast<std::size_t>(told_->now())] +=
        std::chrono::duration<double>(Clock::now() - last_).count();
  return all;
}

void SampledWork::look() {
  using namespace std::chrono_literals;
  std::unique_lock alone(counting_);
  while (!over_) {
    const auto pause = std::clamp<Clock::duration>((Clock::now() - begin_) / 1000, 1ms, 10ms);
    ended_.wait_for(alone, pause);
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(told_->now())] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
}

}  // namespace treejet
