#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"
#include "validation/tests/ranks/files_of_ranks.hpp"

using namespace treejet;
namespace fs = std::filesystem;

TEST_CASE(
    "A jet in subdomains that is stopped and resumed on as many ranks leaves the bytes of one left alone") {
  const Ranks& ranks = started_ranks();
  for (const Deck& deck : {short_jet(), two_rates(), tree_in_space(), refined_jet()}) {
    const SharedPlace whole(ranks), parts(ranks);
    const Ended left_alone = run(deck, whole.path, ranks);
    REQUIRE(left_alone.arrived);
    const std::int64_t stride = left_alone.steps / 4;
    REQUIRE(stride > 2);
    bool arrived = run(deck, parts.path, ranks, stride).arrived;
    int resumed = 0;
    for (; !arrived; ++resumed) arrived = resume(parts.path, ranks, stride + resumed).arrived;
    CHECK(resumed > 2);
    CHECK(of_first(ranks, [&] { return same_files(whole.path, parts.path); }) == 1);
    CHECK(of_first(ranks, [&] { return fs::exists(parts.path / "checkpoint"); }) == 0);
  }
}

TEST_CASE("A jet in subdomains goes on on another number of ranks, to the accuracy of field and steps") {
  const Ranks& ranks = started_ranks();
  // 1e-5 of the field moves observables by less than a tenth of it, as long as the steps are the same; two
  // rates take others where the field is another in its last digits, and tolerance 1e-6 is 1e-5 in x
  const std::vector<std::tuple<Deck, std::size_t, double>> cases = {{short_jet(), 1000, 1e-6},
                                                                    {two_rates(), 5, 1e-5}};
  for (const auto& [deck, columns, apart] : cases) {
    const SharedPlace whole(ranks), parts(ranks);
    const Ended left_alone = run(deck, whole.path, ranks);
    const std::int64_t stride = left_alone.steps / 3;
    CHECK_FALSE(run(deck, parts.path, ranks, stride).arrived);
    // the second third by the first rank alone
    if (ranks.first()) CHECK_FALSE(resume(parts.path, {}, stride).arrived);
    ranks.greatest(0);
    CHECK(resume(parts.path, ranks).arrived);
    const auto between = [&, n = columns] { return difference(whole.path, parts.path, n); };
    CHECK(of_first(ranks, between) < apart);
  }
}

TEST_CASE("A checkpoint of subdomains with a damaged record is passed over by all ranks") {
  const Ranks& ranks = started_ranks();
  const Deck deck = short_jet();
  const SharedPlace whole(ranks), parts(ranks);
  run(deck, whole.path, ranks);
  run(deck, parts.path, ranks, 20);
  resume(parts.path, ranks, 20);
  ranks.greatest(0);
  if (ranks.first()) {
    const auto file = parts.path / "checkpoint";
    std::string bytes = read_whole(file);
    const std::size_t last = bytes.size() - 1;
    // from inside the head to the end, numbers in front of records included
    for (std::size_t at = last % 7 + last / 2; at <= last; at += 7) {
      bytes[at] ^= 1;
      std::ofstream(file, std::ios::binary) << bytes;
      CHECK_THROWS_AS(read_checkpoint(file), FileError);
      if (at + 7 <= last) bytes[at] ^= 1;
    }
  }
  ranks.greatest(0);
  const Resumption older = resumption(parts.path, program({}), {}, readers(ranks));
  CHECK(older.warnings.size() == 1);
  CHECK(older.checkpoint.file == parts.path / "checkpoint.old");
  CHECK(resume(parts.path, ranks).arrived);
  CHECK(of_first(ranks, [&] { return same_files(whole.path, parts.path); }) == 1);
}
