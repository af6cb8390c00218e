#pragma once
/// run.json: what made the files beside it, and under which circumstances.
///
///     {"format": "treejet run record 1", "program", "version", "commit", "compiler", "build", "vector_path",
///      "libraries", "deck": {"name", "text", "overrides"}, "begins_with", "field_map", "files": [...],
///      "segments": [{"started", "host", "ranks", "threads", "ended", "wall_seconds", "outcome", "compute",
///                    "exchange", "wait", "gatherings", "work": {"steps", "multirate", "local", "build",
///                    "upward", "exchange", "evaluate", "tuning", "output"}}, ...],
///      "effort": {"evaluations", "steps", "rejected", "retaken", "inserted", "split", "merged",
///                 "arrived", "beads"},
///      "fixed_step": {"step_error", "samples", "event_lateness"},
///      "means": {"vc": {"unit", "mean", "error", "from", "values", "block", "steady"}, ...}}
///
/// A segment is one process: the first run or a resumption. Its outcome is "running" until it is over, and
/// stays so if the program is killed; then "completed", "stopped early" or "failed". Times are UTC; compute,
/// exchange and wait are seconds of a rank in the mean, and so are the kinds of work
/// (parallel/work_clock.hpp), which add up to the time from the first step to the last. Effort, of all
/// segments together, and means (core/observe/steady_mean.hpp) are those of a completed run; fixed_step
/// (core/observe/step_errors.hpp) is there in runs by `timestep`. This is the only file of a run whose bytes
/// depend on when, where and on how many cores it ran. The only place that knows the JSON library.

#include <chrono>
#include <filesystem>

#include "core/base/output_file.hpp"
#include "core/deck/lab_sheet.hpp"
#include "core/io/provenance.hpp"

namespace treejet {

struct Circumstances {
  int ranks = 1, threads = 1;
};

/// A mean over the steady state, in the unit of its key; from: s.
struct RecordedMean {
  std::string key, unit;
  double mean, error, from;
  int values, block;
  bool steady;
};

/// What a completed run tells of itself.
struct RunResults {
  std::vector<std::pair<std::string, std::int64_t>> effort;
  std::vector<std::pair<std::string, double>> times;  ///< s, of this segment
  std::vector<std::pair<std::string, double>> work;   ///< of its kinds, as times
  std::vector<RecordedMean> means;
  std::vector<std::pair<std::string, double>> fixed_step = {};  ///< empty: not by `timestep`
};

class RunRecord {
 public:
  struct Setting {
    std::filesystem::path directory;
    Provenance made_by;
    std::vector<std::string> files;
    Circumstances circumstances;
    OutputFile::Existing existing = OutputFile::Existing::keep;  ///< resume: adds a segment
  };

  /// Writes the record, with a segment that is running.
  explicit RunRecord(const Setting& setting);
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;
  /// Unless told of the end before: stopped early or, while an exception is under way, failed.
  ~RunRecord();

  void complete(const RunResults& results);

 private:
  void end(const char* outcome, const RunResults& results = {});

  std::filesystem::path path_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  bool ended_ = false;
};

/// How far an observable is off: the greatest of a row, and that of its mean over the rows from `from_row` on
/// (counted from 0), in its own unit; nan where there is no mean.
struct ErrorOfObservable {
  std::string label;  ///< "x[cm]"
  double of_a_row, mean, of_mean;
  int from_row;
  bool steady;
};

/// Adds "error_estimate": {"against", "observables": {"x[cm]": {"row", "mean", "of_mean", "from_row",
/// "steady"}, ...}} to the record of a run that is over.
void record_errors(const std::filesystem::path& directory, const std::string& against,
                   const std::vector<ErrorOfObservable>& errors);

/// The names of the files of the run in a directory, its record among them; none without a sound record.
std::vector<std::string> recorded_files(const std::filesystem::path& directory);

/// Whether the last segment of the run in a directory has come to its end; false without a sound record.
bool has_completed(const std::filesystem::path& directory);

/// What a record tells, for people. FileError if it is none, or cut short.
std::string run_record_text(const std::filesystem::path& path);

/// What `treejet check --json` prints:
///     {"format": "treejet check 1", "deck", "overrides": [...], "directives": {"viscosity": "20", ...},
///      "notes": [...],
///      "laboratory": {"field": {"value", "unit", "meaning", "warning"}, ...}, "plan": {"steps": {...}, ...}}
/// Directives are those in force, given or by default, in CGS. A row without unit is a number; meaning and
/// warning are there where the text has them.
std::string check_record(const Deck& deck, const std::vector<SheetRow>& laboratory,
                         const std::vector<SheetRow>& plan);

}  // namespace treejet
