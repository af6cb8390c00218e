#pragma once
/// What a study shows: tables on the terminal and as CSV, and the claims it checks.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace treejet {

/// A field of a table: to four digits on the terminal, whole in the file. A number that is not one is an
/// empty field.
struct Cell {
  std::string shown, written;

  Cell(double value);
  Cell(std::int64_t value);
  Cell(const std::string& text);
};

/// Prints and writes row by row: what was measured before a study breaks off is not lost.
class ResultTable {
 public:
  /// Columns are written with their units, "error [cm]"; the file is DIRECTORY/NAME.csv.
  ResultTable(const std::filesystem::path& directory, const std::string& name, const std::string& title,
              std::vector<std::string> columns);
  void row(const std::vector<Cell>& cells);

 private:
  std::vector<std::string> columns_;
  std::ofstream file_;
};

class Report {
 public:
  Report(std::filesystem::path directory, bool quick);

  const std::filesystem::path& directory() const { return directory_; }
  const bool quick;  ///< a study that ends within a minute, for the tests

  ResultTable table(const std::string& name, const std::string& title,
                    std::vector<std::string> columns) const;

  /// A claim holds if `found` is in [low, high]; a NaN never is.
  void check(const std::string& claim, double found, double low, double high);
  /// One more of `runs` is done: tells now and then how long the rest will take.
  void progress(const std::string& study, int done, int runs);
  /// Prints and writes all claims; the number of those that do not hold.
  int conclude(const std::string& name) const;

 private:
  struct Claim {
    std::string text;
    double found, low, high;
    bool holds() const { return found >= low && found <= high; }
  };
  using Clock = std::chrono::steady_clock;

  std::filesystem::path directory_;
  std::vector<Claim> claims_;
  Clock::time_point begin_, last_ = Clock::now();
};

}  // namespace treejet
