#pragma once
/// The state that a run begins with where it does not begin with the deck's initial jet: that of another run,
///
///     DIR      its newest checkpoint, of a completed run the state just before its end, or without one the
///              last frame of its traj.h5; a file instead of a directory is that checkpoint or trajectory
///     DIR@t    the frame of its traj.h5 at time t, in s or with a unit
///
/// What is taken: the time, and of each bead position, velocity, stress, charge, mass, volume, number and the
/// columns that the new scene adds (core/jet/columns.hpp), in CGS, and what has been fed since the last
/// release, if the flow is given; of a checkpoint also whether a bead is held at the nozzle. What the deck
/// says of its initial jet has no effect then, but for the length of an element.
///
/// What may differ between the two decks: all but `system` and a charge density of 0 on one side only;
/// columns that the new scene adds must be there. The other run is left as it is. Where only outputs, final
/// time and checkpoints differ, a checkpoint also gives the history of the steps, and the jet goes on to the
/// bit as the other one would. What the tables sum up begins anew: fcn and fcc, differences of sums since the
/// start, may round otherwise, fcc estimates where its first bead was when the last one arrived, and vn is
/// not a number until one is released. Either run may hold its jet in subdomains: its steps go on if both do,
/// to the bit on as many ranks. Each rank of the new one reads the whole state once.
///
/// Errors: FileError if there is no such state, InputError if the deck cannot begin with it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/deck/deck.hpp"
#include "core/io/frame.hpp"
#include "core/restart/checkpoint.hpp"

namespace treejet {

struct Origin {
  std::filesystem::path file;
  Deck deck;     ///< of the run it comes from
  double t = 0;  ///< s
  std::optional<Checkpoint> checkpoint;
  Frame frame;  ///< without a checkpoint
  FrameColumns frame_columns;
};

Origin origin(const std::string& place);

/// "results/checkpoint.end, t = 0.0499 s", and how the decks differ.
std::string description(const Origin& origin, const Parameters& p);

/// The checkpoint, where its steps can be gone on with.
Checkpoint* steps_of(Origin& origin, const Parameters& p);

/// Its jet in the scales of a deck, with the columns that its scene adds.
template <int D>
Jet<D> jet_of(const Origin& origin, const Parameters& p, const Columns& added = {});

}  // namespace treejet
