#include "parallel/ranks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace treejet {

std::vector<int> Ranks::borders(Rows rows, int block) const {
  const int first = rows.first / block, blocks = rows.size() > 0 ? (rows.last - 1) / block + 1 - first : 0;
  std::vector<int> borders;
  for (int k = 0; k <= size_; ++k) {
    const int border = first + static_cast<int>(std::int64_t{blocks} * k / size_);
    borders.push_back(std::clamp(border * block, rows.first, rows.last));
  }
  return borders;
}

std::vector<double> Ranks::of_all(std::span<const double> own) const {
  const auto count = static_cast<int>(own.size());
  std::vector<double> all(own.size() * index(size_));
  std::copy(own.begin(), own.end(), all.begin() + std::ptrdiff_t{rank_} * count);
  std::vector<int> borders;
  for (int k = 0; k <= size_; ++k) borders.push_back(k * count);
  double* const column[] = {all.data()};
  gather(column, borders);
  return all;
}

void Ranks::require_same(const std::string& program, const std::string& deck) const {
  if (!agree(program))
    throw LaunchError(
        "the ranks differ in program or vectors; TREEJET_VECTOR_PATH=avx2 in the environment of "
        "all makes the vectors of different processors alike");
  if (!agree(deck)) throw LaunchError("the ranks have read different decks");
}

std::string Ranks::crowding(Threads threads) const {
  const std::vector<Crowd> all = crowds(threads);
  Crowd worst = {0, 1};
  int crowded = 0;
  for (const Crowd& c : all) {
    if (c.threads <= c.cores) continue;
    ++crowded;
    if (std::int64_t{c.threads} * worst.cores > std::int64_t{worst.threads} * c.cores) worst = c;
  }
  if (crowded == 0 || !first()) return {};
  const std::string who = size_ == 1 ? "" : fmt::format("{} of {} ranks share cores: ", crowded, size_);
  return fmt::format("{}{} threads on {} {}; start fewer, or bind them to more cores", who, worst.threads,
                     worst.cores, worst.cores == 1 ? "core" : "cores");
}

std::string times_description(const GatherTimes& t, double seconds) {
  if (t.count == 0) return {};
  return fmt::format("compute {:.3g} s, exchange {:.3g} s, wait {:.3g} s; {} gatherings\n",
                     seconds - t.exchange - t.wait, t.exchange, t.wait, t.count);
}

}  // namespace treejet
