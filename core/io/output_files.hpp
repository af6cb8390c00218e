#pragma once
/// The files of a run, one row each: what a deck asks for them with, and how large they grow. Who makes them
/// is core/observe/outputs.cpp, who recognises them again core/commands/file_info.cpp.

#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

struct OutputFileKind {
  const char* name;
  bool (*asked_for)(const Parameters& p);
  /// Of a whole run whose frames have so many points in the mean.
  double (*bytes)(const Parameters& p, double points);
  /// At the most while the run goes on; null: not more than at its end.
  double (*bytes_meanwhile)(const Parameters& p, double points) = nullptr;
};

/// All of them.
std::vector<OutputFileKind> all_output_files();

/// The rows of the table that a deck asks for; the record of the run, which stands beside any other, is the
/// last.
std::vector<OutputFileKind> output_files(const Parameters& p);

}  // namespace treejet
