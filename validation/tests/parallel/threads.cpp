#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "parallel/ranks.hpp"
#include "parallel/team.hpp"
#include "parallel/threads.hpp"

using namespace treejet;

TEST_CASE("Threads: each row is visited once and blocks start at multiples of the block from row 0") {
  for (int threads : {1, 2, 3, 8}) {
    std::vector<int> visits(103, 0);
    const Rows rows{5, 98};
    for_each_block({threads}, rows, 10, [&](Rows block) {
      if (threads > 1 && block.first != rows.first && block.first % 10 != 0) throw std::logic_error("border");
      for (int i = block.first; i < block.last; ++i) ++visits[i];
    });
    for (int i = 0; i < 103; ++i) REQUIRE(visits[i] == (i >= 5 && i < 98));
  }
}

TEST_CASE("Threads: what one region wrote the next one reads, whichever threads ran them") {
  // Each pass shifts the values by one row, so every block reads a row that another block wrote a pass
  // before.
  const int n = 64, passes = 50;
  std::vector<double> from(n), to(n);
  std::iota(from.begin(), from.end(), 0.0);
  for (int pass = 0; pass < passes; ++pass) {
    for_each_block({4}, {0, n}, 4, [&](Rows block) {
      for (int i = block.first; i < block.last; ++i) to[i] = from[(i + 1) % n];
    });
    from.swap(to);
  }
  for (int i = 0; i < n; ++i) REQUIRE(from[i] == (i + passes) % n);
}

TEST_CASE("Threads: the caller gets an exception thrown in a block, after all blocks are done") {
  std::vector<int> visits(40, 0);
  const auto visit = [&](Rows block) {
    for (int i = block.first; i < block.last; ++i) ++visits[i];
    if (block.first == 20) throw std::runtime_error("from row 20");
  };
  REQUIRE_THROWS_WITH(for_each_block({4}, {0, 40}, 4, visit), "from row 20");
  REQUIRE(visits == std::vector<int>(40, 1));
}

TEST_CASE("Threads: no rows, no call") {
  for_each_block({4}, {3, 3}, 4, [](Rows) { FAIL("called"); });
  REQUIRE(available_cores() >= 1);
}

TEST_CASE("Threads: each gets its share of the blocks") {
  std::vector<int> sizes;
  std::mutex one_at_a_time;
  for_each_block({3}, {0, 90}, 10, [&](Rows block) {
    const std::lock_guard guard(one_at_a_time);
    sizes.push_back(block.size());
  });
  CHECK(sizes == std::vector<int>{30, 30, 30});
}

TEST_CASE(
    "Threads: a team that ends at any moment ends its threads, those that are just done or hardly begun") {
  // Lengths of work spread the end over all that a helper does; a thread that is lost never joins. One in
  // some hundred was when a flag beside the job told the end.
  const std::function<void(int)> work = [](int turn) {
    volatile int steps = 0;
    while (steps < 2000 + turn % 97 * 100) steps = steps + 1;
  };
  for (int turn = 0; turn < 5000; ++turn) {
    Team team([](int) {});
    for (int k = 0; k < 2; ++k) team.run(2, 2, [&](int task) { work(task == 0 ? 0 : turn); });
  }
}

TEST_CASE("Threads: no more of them are at work than were asked for, however many there are") {
  Team team([](int) {});
  std::mutex one_at_a_time;
  std::set<std::thread::id> seen;
  const auto work = [&](int) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard guard(one_at_a_time);
    seen.insert(std::this_thread::get_id());
  };
  team.run(6, 30, work);
  CHECK(seen.size() > 2);
  seen.clear();
  team.run(2, 30, work);
  CHECK(seen.size() <= 2);
}

TEST_CASE("Ranks: borders of shares stay within the rows that were asked for") {
  CHECK(Ranks().borders({5, 23}, 16) == std::vector<int>{5, 23});
  CHECK(Ranks().borders({0, 0}, 16) == std::vector<int>{0, 0});
}

TEST_CASE("Ranks: more threads than cores are told, as many are not") {
  const Ranks alone;
  CHECK(alone.crowding({available_cores()}).empty());
  CHECK_THAT(alone.crowding({available_cores() + 1}), Catch::Contains("threads on"));
}

TEST_CASE("Ranks: the time that is not spent on exchange and waiting is that of computing") {
  CHECK(times_description({.count = 3, .exchange = 0.5, .wait = 1.5}, 10) ==
        "compute 8 s, exchange 0.5 s, wait 1.5 s; 3 gatherings\n");
  CHECK(times_description({}, 10).empty());
}
