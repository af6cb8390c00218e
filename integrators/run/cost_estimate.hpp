#pragma once
/// What a run will come to - beads, evaluations, time, memory, files - foretold from its first second.
///
/// A trial runs the real scene, without files, for about a second of wall-clock time; if that is all of it,
/// the plan is the truth. Otherwise its second half is continued:
///
/// Beads. The nozzle goes on to insert at the rate it has, for it sees only the last few beads. Nothing
/// leaves before the first bead arrives: from place x and speed v of the last sample, with the acceleration a
/// since the middle of the trial, or that of field and gravity on a lone bead if it is larger (the push of
/// the beads behind only adds to it),
///     H - x = v s + a s^2 / 2 .
/// From then on as many leave as enter, and the number stays. If beads have arrived in the trial, their
/// number since is the number. Without removal it grows to the end; without insertion it is what it is.
///
/// Work. Steps go from event to event, or are of fixed length: evaluations and steps keep their rates. Where
/// none is inserted, or beads spread, an adaptive step may grow, and the plan is then too high.
///
/// Time. An evaluation costs alpha + beta n^k, fitted to the trial; k = 2 where every evaluation sums over
/// all pairs, else 1: two rates and the tree. Files are not counted in.
///
/// Sizes of files follow from the formats and the mean number of beads, that of traj.h5 with the compression
/// found in case 3, 0.46.

#include <optional>
#include <string>
#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

/// The state of a trial at one instant.
struct TrialSample {
  double seconds = 0;  ///< of wall-clock time since its start
  double t = 0;        ///< scaled
  std::int64_t beads = 0, inserted = 0, removed = 0, evaluations = 0, steps = 0;
  double x = 0, v = 0;  ///< of the oldest bead along the axis, scaled
};

struct Trial {
  std::vector<TrialSample> samples;          ///< the first one at the start
  bool complete = false;                     ///< to the final time
  std::optional<double> first_arrival = {};  ///< if there was one, scaled
};

struct Plan {
  double most_beads = 0, mean_beads = 0;
  double inserted = 0;
  std::optional<double> first_arrival;  ///< s
  double evaluations = 0, steps = 0;
  double seconds = 0;  ///< of wall-clock time
  double memory = 0;   ///< bytes
};

/// InputError, before anything is composed, if the beads of the deck do not fit into the memory of this
/// machine or a step of the direct sum would take hours.
void expect_feasible_trial(const Parameters& p);

/// All pairs: whether each evaluation sums over them.
Plan plan(const Parameters& p, const Trial& trial, bool all_pairs);

/// What `treejet check` prints.
std::string plan_description(const Parameters& p, const Trial& trial, bool all_pairs);

}  // namespace treejet
