#include "parallel/sampled_work.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <thread>

using namespace treejet;

namespace {

using Clock = std::chrono::steady_clock;

/// Takes so many milliseconds, at the least.
void work(int milliseconds) {
  const auto end = Clock::now() + std::chrono::milliseconds(milliseconds);
  while (Clock::now() < end) {
  }
}

double of(const WorkClock& clock, Work work) {
  return clock.seconds()[static_cast<std::size_t>(work)];
}

}  // namespace

TEST_CASE("Kinds of work add up to the time, each without what is done inside it") {
  const auto before = Clock::now();
  const WorkClock clock;
  const auto begin = Clock::now();
  {
    const Working outer(Work::local);
    work(4);
    {
      const Working inner(Work::evaluate);
      work(2);
      const Working again(Work::evaluate);
      work(1);
    }
    work(1);
  }
  const double least = std::chrono::duration<double>(Clock::now() - begin).count();
  const WorkSeconds seconds = clock.seconds();
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const double most = std::chrono::duration<double>(Clock::now() - before).count();
  // sums of a few differences of times round in their last digits
  CHECK(all >= least * (1 - 1e-12));
  CHECK(all <= most * (1 + 1e-12));
  CHECK(of(clock, Work::local) >= 0.005);
  CHECK(of(clock, Work::evaluate) >= 0.003);
  CHECK(of(clock, Work::build) == 0);
}

TEST_CASE("What tuning does inside belongs to tuning") {
  const WorkClock clock;
  {
    const Working tuning(Work::tuning);
    const Working inside(Work::build);
    work(1);
  }
  CHECK(of(clock, Work::tuning) >= 0.001);
  CHECK(of(clock, Work::build) == 0);
  { const Working build(Work::build); }
  CHECK(of(clock, Work::build) > 0);
}

TEST_CASE("A clock tells of its own thread, and of nothing once it has gone") {
  const WorkClock outer;
  {
    const WorkClock inner;
    const Working at(Work::build);
    std::thread([] {
      const Working elsewhere(Work::output);
      work(1);
    }).join();
    CHECK(of(inner, Work::output) == 0);
    CHECK(of(inner, Work::build) >= 0.001);
  }
  CHECK(of(outer, Work::build) == 0);
  { const Working at(Work::upward); }
  CHECK(of(outer, Work::upward) > 0);
}

TEST_CASE("A thread that looks what is being done finds the parts of the time that it takes") {
  const auto before = Clock::now();
  const SampledWork sampled;
  for (int k = 0; k < 40; ++k) {
    const Working outer(Work::local);
    work(1);
    const Working inner(Work::build);
    work(3);
  }
  const WorkSeconds seconds = sampled.seconds();
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const double most = std::chrono::duration<double>(Clock::now() - before).count();
  CHECK(all <= most * (1 + 1e-12));  // rounds as above
  CHECK(all >= 0.16);
  const double local = seconds[static_cast<std::size_t>(Work::local)],
               build = seconds[static_cast<std::size_t>(Work::build)];
  // 160 looks know a part of three quarters to 0.03; a thread that gets no core in time looks less often
  CHECK(build > local);
  CHECK(seconds[static_cast<std::size_t>(Work::upward)] == 0);
}

TEST_CASE("Where a clock is told already, nobody looks") {
  const WorkClock clock;
  const SampledWork sampled;
  {
    const Working at(Work::build);
    work(1);
  }
  CHECK(of(clock, Work::build) >= 0.001);
  const WorkSeconds seconds = sampled.seconds();
  CHECK(std::accumulate(seconds.begin(), seconds.end(), 0.0) == 0);
}
