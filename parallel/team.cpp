#include "parallel/team.hpp"

namespace treejet {

namespace {

constexpr std::uint64_t one_job = std::uint64_t{1} << 32;
/// Of the end of the team. It is told in the word that threads sleep on: with a flag beside it a thread that
/// has looked at the flag already, not yet at the job, would sleep for ever.
constexpr std::uint64_t over = ~std::uint64_t{0};
/// Looks at what is waited for, others being let go ahead, before a thread sleeps: half a millisecond where
/// nobody else wants the core. To wake a core that has gone idle takes longer than most pauses between jobs,
/// on a virtual machine most of all: with 20 looks two threads took 1.1 times as long (1e5 beads, by turns).
constexpr int looks = 2000;

std::uint64_t job(std::uint64_t job_and_task) {
  return job_and_task / one_job;
}
int task(std::uint64_t job_and_task) {
  return static_cast<int>(job_and_task % one_job);
}
bool is_open(std::uint64_t job_and_task) {
  return job(job_and_task) % 2 == 0;
}

template <class Condition>
bool soon(Condition holds) {
  for (int k = 0; k < looks; ++k) {
    if (holds()) return true;
    std::this_thread::yield();
  }
  return false;
}

}  // namespace

Team::~Team() {
  job_and_task_ = over;
  job_and_task_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run(int threads, int count, const std::function<void(int)>& f) {
  const bool shares = threads > 1 && count > 1 && !busy_.test_and_set();
  if (!shares) {
    for (int k = 0; k < count; ++k) f(k);
    return;
  }
  share(threads, count, f);
  busy_.clear();
}

/// A job is closed while it is described: whoever has seen the one before can take no task of it by then.
void Team::share(int threads, int count, const std::function<void(int)>& f) {
  while (static_cast<int>(threads_.size()) < threads - 1)
    threads_.emplace_back([this, number = static_cast<int>(threads_.size()) + 1] { work(number); });
  const std::uint64_t closed = (job(job_and_task_) | 1) * one_job;
  job_and_task_ = closed;
  f_ = &f;
  count_ = count;
  helpers_ = threads - 1;
  done_ = 0;
  job_and_task_ = closed + one_job;
  job_and_task_.notify_all();
  take_part(0);
  if (soon([&] { return done_ == count; })) return;
  for (int done = done_; done < count; done = done_) done_.wait(done);
}

/// Tasks of the job that is open, until there are no more, if it has room for the helper of that number;
/// whoever asks has number 0. A task is taken only if the job is still the one whose words have been read.
/// Returns the job and task in which there was nothing to take.
std::uint64_t Team::take_part(int number) {
  while (true) {
    std::uint64_t next = job_and_task_;
    const std::function<void(int)>* const f = f_;
    const int count = count_;
    const bool has_room = number <= helpers_;
    if (!is_open(next) || task(next) >= count || !has_room) return next;
    if (!job_and_task_.compare_exchange_strong(next, next + 1)) continue;
    (*f)(task(next));
    if (++done_ == count) done_.notify_one();
  }
}

void Team::work(int number) {
  at_start_(number);
  while (true) {
    const std::uint64_t seen = take_part(number);
    if (seen == over) return;
    if (!soon([&] { return job(job_and_task_) != job(seen); })) job_and_task_.wait(seen);
  }
}

}  // namespace treejet
