#pragma once
/// Means over the steady state, with their standard error: what one quotes of a run.
///
/// Start.   MSER: of all starts in the first half of the series, the one at which the estimated variance of
///          the mean, s^2 / m of the m values from there on, is least (White, Simulation 69 (1997) 323).
///          Block means of 5 values carry the search, as long as there are 50 values.
/// Error.   Block averaging: the standard error from means of blocks of B values grows with B until the
///          blocks are independent (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461). The smallest B is
///          taken, of sizes that grow by a quarter, with B^3 > 2 m (e_B / e_1)^4, which weighs bias against
///          noise (Lee et al., Phys. Rev. E 83 (2011) 066706).
/// Steady   if the two halves of what is left agree: their means differ by at most 3 of the difference's
///          standard errors, 2 e, and what one value more or less moves them, and a millionth of them; and B
///          leaves 4 blocks at least.
///
/// A window without a value (nan) is passed over. python/treejet/means.py is the same rule for files.

#include <string>
#include <vector>

#include "core/io/run_record.hpp"
#include "core/observe/recorder.hpp"

namespace treejet {

struct SteadyMean {
  double mean, error;  ///< nan where the series is too short to tell
  int start = 0;       ///< row from which on the mean is taken
  int values = 0;      ///< rows in it
  int block = 0;       ///< values in a block
  bool steady = false;
};

/// Of a series taken at equal times.
SteadyMean steady_mean(const std::vector<double>& series);

/// Keeps the rows of a run for their means; the first one, the state at the start, is in none.
class SteadyMeans final : public RowSink {
 public:
  /// "key[unit]" of the values in a row, time first.
  explicit SteadyMeans(std::vector<std::string> labels)
      : labels_(std::move(labels)), series_(labels_.size()) {}

  void row(const std::vector<double>& values) override;
  void visit(Archive& state) override { state(series_); }

  std::vector<RecordedMean> means() const;

 private:
  std::vector<std::string> labels_;
  std::vector<std::vector<double>> series_;
};

/// Whether rows of this key have one: times, wall clocks and counters have none.
bool has_mean(const std::string& key);

/// The time, and of these keys, each once, those that have a mean: no times, no wall clocks, no counters.
std::vector<std::string> keys_with_means(const std::vector<std::string>& keys);

/// Lines for the summary of a run; none if there are no means.
std::vector<std::string> description(const std::vector<RecordedMean>& means);

}  // namespace treejet
