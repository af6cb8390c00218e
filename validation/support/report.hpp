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
  /// Columns are written with their units, "error [cm]"; the file is DIRECTORY/NAME.csv. Without a title it
  /// is written only.
  ResultTable(const std::filesystem::path& directory, const std::string& name, const std::string& title,
              std::vector<std::string> columns);
  void row(const std::vector<Cell>& cells);

 private:
  bool shown_;
  std::vector<std::string> columns_;
  std::ofstream file_;
};

/// A part of the report: what is asked, and the command that asks it again.
struct ReportSection {
  std::string title, asked, reproduce;
};

/// What somebody else found of the same quantity, and the largest difference that is no contradiction.
struct Elsewhere {
  double value, allowed;
  std::string source;
};

/// What theory says, in closed form, and between what bounds a computation of it lies for a reason.
struct ClosedAnswer {
  double value, low, high;
  std::string theory;
};

/// Not as elsewhere, and it is known why: the explanation foretells a value in [low, high], and fails with
/// it.
struct Difference {
  double elsewhere, low, high;
  std::string explanation;
};

class Report {
 public:
  Report(std::filesystem::path directory, bool quick);

  const std::filesystem::path& directory() const { return directory_; }
  const bool quick;                  ///< a study that ends within a minute, for the tests
  std::filesystem::path decks = {};  ///< folder of JETSPIN's example decks; empty: not at hand

  /// What follows belongs to it.
  void section(const ReportSection& section);

  ResultTable table(const std::string& name, const std::string& title, std::vector<std::string> columns);

  /// A claim holds if `found` is in [low, high]; a NaN never is.
  void check(const std::string& claim, double found, double low, double high);
  void compare(const std::string& claim, double found, const Elsewhere& elsewhere);
  void compare(const std::string& claim, double found, const ClosedAnswer& answer);
  void differs(const std::string& claim, double found, const Difference& difference);
  /// What there is to judge, and why it is not.
  void not_judged(const std::string& claim, const std::string& why);
  /// One more of `runs` is done: tells now and then how long the rest will take.
  void progress(const std::string& study, int done, int runs);
  /// Prints all claims and writes checks.csv, and sections.csv and tables.csv, which tell what belongs
  /// together; the number of claims that do not hold.
  int conclude();

 private:
  struct Claim {
    std::string section, text;
    double found, low, high, elsewhere;
    std::string remark;  ///< source of the value elsewhere, or why it differs
    bool explained, judged = true;
    bool holds() const { return !judged || (found >= low && found <= high); }
    std::string verdict() const {
      if (!judged) return "not judged";
      return !holds() ? "FAILS" : explained ? "differs, explained" : "holds";
    }
  };
  struct Entry {
    std::string section, table, title;
  };
  void add(Claim claim);

  using Clock = std::chrono::steady_clock;

  std::filesystem::path directory_;
  std::vector<ReportSection> sections_;
  std::vector<Entry> tables_;
  std::vector<Claim> claims_;
  Clock::time_point begin_, last_ = Clock::now();
};

}  // namespace treejet
