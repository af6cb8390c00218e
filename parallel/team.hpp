#pragma once
/// Threads that wait for tasks of the one that started them, and take them when they come in time.
///
/// Whoever asks works at the tasks, too, and goes on when all are done, whether the others have woken up or
/// not: where cores are shared with other programs, a thread that gets no core holds nobody up, as it would
/// at the barrier of a parallel region. (OpenMP's, which spins ahead of it, took 6 to 16 times as long with
/// two threads as with one on a machine with 18 runnable processes a core; this takes as long.) Waiting
/// threads look for new tasks for half a millisecond, in which the next are likely to come, and then sleep.

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace treejet {

class Team {
 public:
  /// `at_start` is called by each new thread, with its number from 1 on.
  explicit Team(std::function<void(int number)> at_start) : at_start_(std::move(at_start)) {}
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls f(0), ..., f(count - 1), each once, by at most so many threads. f throws nothing. Where the team
  /// is at work already, one of its tasks asking or another thread, the caller does all by itself.
  void run(int threads, int count, const std::function<void(int)>& f);

 private:
  void share(int threads, int count, const std::function<void(int)>& f);
  std::uint64_t take_part(int number);
  void work(int number);

  /// The number of the job (odd: none can be taken), and of the next task; all ones at the end of the team.
  std::atomic<std::uint64_t> job_and_task_{0};
  std::atomic<const std::function<void(int)>*> f_{nullptr};
  std::atomic<int> count_{0}, helpers_{0}, done_{0};
  std::atomic_flag busy_;  ///< no mutex: a task that asks holds it already
  std::function<void(int)> at_start_;
  std::vector<std::thread> threads_;
};

}  // namespace treejet
