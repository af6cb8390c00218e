#pragma once
/// Tests that ranks make together (treejet-tests-on-ranks, started by mpirun). All ranks run all tests, and
/// what they check is the same on all of them, or else one would go on to wait for the others for ever.

#include "parallel/ranks.hpp"

namespace treejet {

/// Those this program was started as.
const Ranks& started_ranks();

}  // namespace treejet
