#pragma once
/// Mutants of bytes by fixed random numbers: flipped bits, other bytes, numbers of all sizes, pieces taken
/// out, doubled, cut off, or taken from another seed.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace treejet::fuzz {

class Mutator {
 public:
  explicit Mutator(std::vector<std::string> seeds) : seeds_(std::move(seeds)) {}

  /// The next mutant of a seed, after one change or a few.
  std::string next();

 private:
  std::size_t below(std::size_t end) { return end > 0 ? random_() % end : 0; }
  const std::string& seed() { return seeds_[below(seeds_.size())]; }
  void change(std::string& bytes);
  void put_number(std::string& bytes, std::size_t at);
  void splice(std::string& bytes, std::size_t at);

  std::vector<std::string> seeds_;
  std::mt19937_64 random_{2026};  // the same on every machine, and so are remainders of it
};

}  // namespace treejet::fuzz
