#include "core/observe/steady_mean.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace treejet {

namespace {

/// Relative: a jet that tends to a fixed value without noise is steady once nobody would quote the
/// difference.
constexpr double same = 1e-6;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
using Values = std::span<const double>;

double mean(Values v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / double(v.size());
}

/// Means of whole blocks; of what is left over the oldest values are left out, or the newest.
std::vector<double> block_means(Values v, std::size_t block, bool without_oldest) {
  const std::size_t count = v.size() / block, first = without_oldest ? v.size() % block : 0;
  std::vector<double> means;
  for (std::size_t k = 0; k < count; ++k) means.push_back(mean(v.subspan(first + k * block, block)));
  return means;
}

std::size_t mser_start(Values v) {
  constexpr std::size_t few = 5;
  const std::size_t batch = v.size() >= 10 * few ? few : 1;
  const std::vector<double> means = block_means(v, batch, false);
  const double centre = means.back();  // a constant end has variance 0 to the bit
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity(), sum = 0, squares = 0;
  for (std::size_t k = means.size(); k-- > 0;) {
    const double d = means[k] - centre, m = double(means.size() - k);
    sum += d, squares += d * d;
    const double variance_of_mean = (squares / m - sum / m * (sum / m)) / m;
    if (k <= means.size() / 2 && variance_of_mean <= least) least = variance_of_mean, best = k;
  }
  return batch * best;
}

struct BlockError {
  double error;
  std::size_t block;
};

BlockError block_error(Values v) {
  double plain = -1;
  std::size_t block = 1;
  for (; v.size() / block >= 4; block += 1 + block / 4) {
    const std::vector<double> means = block_means(v, block, true);
    const double centre = mean(means), count = double(means.size());
    double squares = 0;
    for (const double m : means) squares += (m - centre) * (m - centre);
    const double error = std::sqrt(squares / (count - 1) / count);
    if (plain < 0) plain = error;
    if (plain == 0 || std::pow(double(block), 3) > 2 * double(v.size()) * std::pow(error / plain, 4))
      return {error, block};
  }
  return {none, block};
}

}  // namespace

SteadyMean steady_mean(const std::vector<double>& series) {
  std::vector<double> kept;
  std::vector<int> rows;
  for (std::size_t k = 0; k < series.size(); ++k)
    if (std::isfinite(series[k])) kept.push_back(series[k]), rows.push_back(static_cast<int>(k));
  if (kept.empty()) return {none, none};
  const std::size_t first = mser_start(kept);
  const Values rest = Values(kept).subspan(first);
  const BlockError e = block_error(rest);
  const std::size_t half = rest.size() / 2;
  double apart = std::numeric_limits<double>::infinity(), one_value = 0;
  if (half > 0) {
    apart = std::abs(mean(rest.first(half)) - mean(rest.subspan(half)));
    const auto [low, high] = std::minmax_element(rest.begin(), rest.end());
    one_value = (*high - *low) / double(half);
  }
  return {mean(rest),
          e.error,
          rows[first],
          static_cast<int>(rest.size()),
          static_cast<int>(e.block),
          std::isfinite(e.error) && apart <= 6 * e.error + one_value + same * std::abs(mean(rest))};
}

void SteadyMeans::row(const std::vector<double>& values) {
  for (std::size_t k = 0; k < values.size(); ++k) series_[k].push_back(values[k]);
}

std::vector<RecordedMean> SteadyMeans::means() const {
  std::vector<RecordedMean> all;
  for (std::size_t k = 1; k < labels_.size(); ++k) {
    const std::vector<double>& series = series_[k];
    if (series.size() < 2) continue;
    const SteadyMean m = steady_mean({series.begin() + 1, series.end()});
    if (m.values == 0) continue;
    const std::size_t bracket = labels_[k].find('[');
    const std::string unit = labels_[k].substr(bracket + 1, labels_[k].size() - bracket - 2);
    all.push_back({labels_[k].substr(0, bracket), unit, m.mean, m.error,
                   series_[0][static_cast<std::size_t>(m.start) + 1], m.values, m.block, m.steady});
  }
  return all;
}

bool has_mean(const std::string& key) {
  constexpr std::string_view no_mean[] = {"t", "ts", "cpu", "cpue", "cpur", "f", "l", "nref", "nmrg"};
  return std::find(std::begin(no_mean), std::end(no_mean), key) == std::end(no_mean);
}

std::vector<std::string> keys_with_means(const std::vector<std::string>& keys) {
  std::vector<std::string> kept{"t"};
  for (const std::string& key : keys)
    if (has_mean(key) && std::find(kept.begin(), kept.end(), key) == kept.end()) kept.push_back(key);
  return kept;
}

std::vector<std::string> description(const std::vector<RecordedMean>& means) {
  std::vector<std::string> lines, unsteady;
  for (const RecordedMean& m : means) {
    if (!m.steady) {
      unsteady.push_back(m.key);
      continue;
    }
    if (lines.empty()) lines.push_back(fmt::format("means over the steady state, with their standard error"));
    lines.push_back(fmt::format("  {:<5} {:>12.6g} +- {:<8.2g} {:<11} {} rows from t = {:.4g} s on", m.key,
                                m.mean, m.error, m.unit == "1" ? "" : m.unit, m.values, m.from));
  }
  if (!unsteady.empty())
    lines.push_back(fmt::format("not steady, or too short to tell: {}", fmt::join(unsteady, " ")));
  return lines;
}

}  // namespace treejet
