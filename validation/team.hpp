#pragma once
/// Ranks and threads started together for one measurement, each worker on a core of its own where there are
/// so many.

#include <string>

namespace treejet {

struct Team {
  int ranks, threads;
  int workers() const { return ranks * threads; }
  bool serial() const { return workers() == 1; }
};

/// Empty without MPI.
std::string mpi_launcher();

/// What this program prints when a team runs it with other arguments, from "measured " on; FileError if it
/// fails.
std::string output(const Team& team, int cores, const std::string& arguments);

}  // namespace treejet
