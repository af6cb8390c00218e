#include <catch2/catch.hpp>

#include "validation/tests/ranks/ranked.hpp"

using namespace treejet;

TEST_CASE("Messages between ranks arrive whole, empty ones as empty ones") {
  const Ranks& ranks = started_ranks();
  Ranks::Messages out(static_cast<std::size_t>(ranks.size()));
  // rank a writes a + b words to rank b
  for (int to = 0; to < ranks.size(); ++to)
    out[static_cast<std::size_t>(to)].assign(static_cast<std::size_t>(ranks.rank() + to),
                                             100 * ranks.rank() + to);
  const Ranks::Messages in = ranks.exchange(out);
  bool right = in.size() == out.size();
  for (int from = 0; right && from < ranks.size(); ++from)
    right = in[static_cast<std::size_t>(from)] ==
            std::vector<double>(static_cast<std::size_t>(ranks.rank() + from), 100 * from + ranks.rank());
  CHECK(ranks.greatest(right ? 0 : 1) == 0);
}

TEST_CASE("Messages sent alone arrive in the order in which they are sent, long, short and empty") {
  const Ranks& ranks = started_ranks();
  const int next = (ranks.rank() + 1) % ranks.size(), last = (ranks.rank() + ranks.size() - 1) % ranks.size();
  if (ranks.size() == 1) return;
  // the long ones are more than what waits anywhere but with the sender
  const std::vector<std::size_t> lengths = {1'000'000, 0, 3, 1, 200'000};
  for (const std::size_t length : lengths) ranks.send(next, std::vector<double>(length, ranks.rank()));
  bool right = true;
  for (const std::size_t length : lengths)
    right = ranks.receive(last) == std::vector<double>(length, last) && right;
  CHECK(ranks.greatest(right ? 0 : 1) == 0);
}

TEST_CASE("A sum over ranks has the same bits on all of them") {
  const Ranks& ranks = started_ranks();
  double numbers[] = {0.1 * (ranks.rank() + 1), 1, 1e-17};
  ranks.sum(numbers);
  CHECK(numbers[1] == ranks.size());
  CHECK(numbers[0] == Approx(0.05 * ranks.size() * (ranks.size() + 1)));
  const std::string bits(reinterpret_cast<const char*>(numbers), sizeof numbers);
  CHECK(ranks.agree(bits));
}

TEST_CASE("Ranks agree on what is the same everywhere, and not where one alone has something else") {
  const Ranks& ranks = started_ranks();
  CHECK(ranks.agree("the same deck"));
  const bool last = ranks.rank() == ranks.size() - 1;
  CHECK(ranks.agree(last ? "another deck" : "the same deck") == (ranks.size() == 1));
}

TEST_CASE("The greatest of the ranks' numbers is known to all") {
  const Ranks& ranks = started_ranks();
  CHECK(ranks.greatest(ranks.rank()) == ranks.size() - 1);
  CHECK(ranks.greatest(-0.5 * ranks.rank()) == 0);
}
