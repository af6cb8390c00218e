#pragma once
/// A run as an experiment: how a jet is moved, what came of it, what it cost and how it ended.
///
/// Units are the deck's (cm, s). Runs are on one thread and `seconds` are those of the processor, so that
/// what else the machine does counts little. An experiment that fails is a result as well: nothing is thrown
/// but InputError and FileError of a deck that cannot be read.

#include <filesystem>
#include <string>
#include <vector>

#include "core/jet/parameters.hpp"
#include "integrators/march/march.hpp"
#include "validation/support/example.hpp"

namespace treejet {

/// How to step: `timestep` (s) or `tolerance`, the other one empty.
struct Method {
  Scheme scheme = Scheme::verner6;
  std::optional<double> timestep = {}, tolerance = {};
  Multirate multirate = Multirate::no;
  EventRule events = EventRule::located;
};

/// A state that no deck can describe: scaled quantities of single beads of the initial jet, replaced.
struct Alteration {
  Eigen::Index bead, column;
  double value;
};

struct Setup {
  std::vector<Alteration> alterations = {};
  std::int64_t most_evaluations = 100'000'000;  ///< beyond, the run is given up
  int repeats = 1;                              ///< the cheapest of so many runs counts
  std::filesystem::path results = {};           ///< where the run's tables go; empty: nowhere
};

struct Outcome {
  static constexpr int given_up = -1;

  int exit_code = 0;    ///< as of the program (core/base/error.hpp), or given_up
  std::string message;  ///< why it ended early
  double t = 0;         ///< s, where it ended
  std::int64_t removed = 0;
  Eigen::ArrayX3d position;  ///< of the beads, oldest first, cm
  Effort effort;
  double seconds = 0;

  bool done() const { return exit_code == 0; }
  bool finite() const { return position.isFinite().all(); }
  double x() const { return position(0, 0); }  ///< of the oldest bead, along the axis
  double yz() const { return position.row(0).tail(2).matrix().norm(); }  ///< and off the axis
};

Parameters with(Parameters p, const Method& method);

Outcome experiment(const Parameters& p, const Setup& setup = {});

/// How far the beads that both jets have are apart at the most, cm; infinite if a run has failed.
double distance(const Outcome& a, const Outcome& b);

/// "Dormand-Prince 5(4), multirate", and the like: one name, one colour in all pictures.
std::string name(const Method& method);

}  // namespace treejet
