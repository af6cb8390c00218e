#pragma once
/// Commands that are written in Python (python/treejet) and reached through the same front door:
///
///     treejet view|plot|movie|sweep|converge|export ...   becomes   python3 -m treejet view ...
///
/// The package is found beside the program: in ../share/treejet/python of an installation, in ../../python of
/// a checkout. The first of python3 on PATH and /usr/bin/python3 is taken that has the modules. $TREEJET
/// tells it which program to run.

#include <array>

namespace treejet {

struct Companion {
  const char* word;
  const char* what;
};

inline constexpr std::array<Companion, 6> companions{
    {{"view", "Write one HTML file to turn, zoom and play the jet of a run in"},
     {"plot", "Draw the jet and the observables of a run"},
     {"movie", "Draw the frames of a run as mp4 or gif"},
     {"sweep", "Run a deck for many values of some directives"},
     {"converge", "Tell how far the steady means of a deck are off by time steps, force and elements"},
     {"export", "Write the trajectory of a run as GSD or VTKHDF"}}};

/// Replaces this process by Python if the first argument is one of these words, else returns. FileError
/// without the package, or without a Python that has the modules.
void hand_over_to_companion(int argc, char** argv);

}  // namespace treejet
