#pragma once
/// `treejet run`: composes a deck's scene and simulates it, from its start or from a checkpoint.

#include "core/base/output_file.hpp"
#include "core/commands/command_line.hpp"
#include "integrators/run/own_physics.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

/// Runs the deck of the arguments, or resumes the run that they name; returns the exit code of the program.
int run_deck(const Arguments& arguments, const Ranks& ranks, const OwnPhysics& own);

/// The threads of each rank; warns where they have too few cores.
Threads threads(const Arguments& arguments, const Ranks& ranks);

/// What the arguments want done with files that exist.
OutputFile::Existing existing(const Arguments& arguments);

/// "treejet 0.1.0 (...), ..., avx512 vectors"
std::string version_text(const OwnPhysics& own);

}  // namespace treejet
