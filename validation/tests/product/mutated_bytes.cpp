/// The readers of validation/fuzz/target.hpp under mutants of what the program writes, by fixed random
/// numbers. A mutant that is neither read nor refused is left in the folder for temporary files.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "validation/fuzz/mutation.hpp"
#include "validation/fuzz/target.hpp"

using namespace treejet;

namespace {

void check(std::string_view name, int count) {
  const fuzz::Target& target = fuzz::target(name);
  const std::vector<std::string> seeds = target.seeds();
  REQUIRE(seeds.size() > 1);
  for (const std::string& seed : seeds) target.read(seed);
  fuzz::Mutator mutants(seeds);
  for (int k = 0; k < count; ++k) {
    const std::string mutant = mutants.next();
    try {
      target.read(mutant);
    } catch (const std::exception& fault) {
      const auto left = std::filesystem::temp_directory_path() / fmt::format("treejet-mutant-{}-{}", name, k);
      std::ofstream(left, std::ios::binary) << mutant;
      FAIL(left.string() << ": " << fault.what());
    }
  }
}

}  // namespace

TEST_CASE("Two thousand mutants of decks are each read or refused") {
  check("deck", 2000);
}

TEST_CASE("Two thousand mutants of checkpoints are each read or refused, with right checksums, too") {
  check("checkpoint", 2000);
}

TEST_CASE("Mutants of trajectories are each read or refused") {
  check("trajectory", 500);
}

TEST_CASE("Two thousand mutants of tables of charges are each read or refused") {
  check("points", 2000);
}

TEST_CASE("Two thousand mutants of a run's text files are each told about or refused") {
  check("written", 2000);
}

TEST_CASE("Two thousand mutants of field maps are each read or refused") {
  check("field-map", 2000);
}

TEST_CASE("Five thousand mutants of numbers with units are each read or refused") {
  check("quantity", 5000);
}
