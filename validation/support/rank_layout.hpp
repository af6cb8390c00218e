#pragma once
/// Ranks and threads started together in processes of their own.

#include <string>

namespace treejet {

struct RankLayout {
  int ranks, threads;
  int workers() const { return ranks * threads; }
  bool serial() const { return workers() == 1; }
};

/// Empty without MPI.
std::string mpi_launcher();

/// The shell's line that starts a program as such a team; pinned: each worker on a core of its own.
std::string launch_line(const RankLayout& layout, bool pinned, const std::string& program,
                        const std::string& arguments);

/// What this program prints when a team runs it with other arguments, from "measured " on, its workers pinned
/// where there are so many cores; FileError if it fails.
std::string output(const RankLayout& layout, int cores, const std::string& arguments);

/// The same of one serial program that is pinned to a core.
std::string output_on_core(int core, const std::string& arguments);

}  // namespace treejet
