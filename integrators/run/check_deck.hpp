#pragma once
/// `treejet check`: what a deck composes and leaves out, and what its run will come to.

#include "core/commands/command_line.hpp"
#include "integrators/run/own_physics.hpp"

namespace treejet {

/// Prints it. InputError if not even a trial of this deck would come to an end here.
void check_deck(const Arguments& arguments, const OwnPhysics& own);

}  // namespace treejet
