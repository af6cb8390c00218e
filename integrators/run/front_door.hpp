#pragma once
/// The front door: arguments -> command -> exit code. A program with physics of its own is this one call, and
/// has all commands of `treejet`.

#include "integrators/run/own_physics.hpp"

namespace treejet {

/// What `main` returns. Errors are told on stderr.
int front_door(int argc, char** argv, const OwnPhysics& own = {});

}  // namespace treejet
