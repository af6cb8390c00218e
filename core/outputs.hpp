#pragma once
/// The watchers that a deck asks for: terminal table, statdat.dat, traj.xyz, progress, and a warning should
/// approximate forces miss their accuracy. What it does not ask for is not made: no file, no array.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/output_file.hpp"
#include "core/parameters.hpp"
#include "core/watcher.hpp"

namespace treejet {

template <int D>
class Nozzle;
class Collector;
struct ForceError;
template <int D>
class Trajectory;

struct OutputSetting {
  std::filesystem::path directory;
  OutputFile::Existing existing = OutputFile::Existing::keep;
  bool quiet = false;
  const ForceError* force_error = nullptr;  ///< null: exact forces
};

template <int D>
class Outputs {
 public:
  /// Opens the files; FileError if one exists already or cannot be made.
  Outputs(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
          const OutputSetting& setting);
  ~Outputs();

  std::vector<Watcher<D>*> watchers() const;
  /// One line a file, for the closing summary.
  std::vector<std::string> summary() const;

 private:
  std::vector<std::unique_ptr<Watcher<D>>> watchers_;
  std::vector<std::filesystem::path> files_;
  const Trajectory<D>* trajectory_ = nullptr;
  int maxnum_;
  const ForceError* force_error_;
};

}  // namespace treejet
