#pragma once
/// Whether a state can be gone on with, and if not, what to tell the user.

#include <optional>
#include <string>

#include "core/base/row_sharing.hpp"
#include "core/jet/jet.hpp"

namespace treejet {

/// Empty if every number of y, a state or a slope, is finite; else a sentence that names the bead and the
/// likely cause. `before` is the last good state, with the same rows.
template <int D>
std::optional<std::string> not_finite(const State<D>& before, const State<D>& y, std::int64_t removed,
                                      const RowSharing& rows_shared = all_at_once);

/// The same for a new state, whose beads must be in order, too: in one dimension along x, in three without an
/// element that has turned by more than a right angle within the step, and the youngest not thrown behind the
/// nozzle by more than an element, l_step scaled.
template <int D>
std::optional<std::string> state_check(const State<D>& before, const State<D>& y, double l_step,
                                       std::int64_t removed, const RowSharing& rows_shared = all_at_once);

}  // namespace treejet
