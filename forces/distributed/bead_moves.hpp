#pragma once
/// Beads on their way between the ranks of a chain: each rank names the beads that it wants, gets those that
/// it has not from the ranks whose own they are, and copies the others from its rows.
///
/// All calls are made by all ranks, and every rank knows what each wants.

#include <functional>

#include "forces/distributed/bead_words.hpp"
#include "forces/distributed/layout.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

/// Beads that a rank wants, ascending.
using Wanted = std::function<std::vector<Stretch>(int rank)>;

/// Rows of a rank as columns of numbers.
using PackedRows = std::function<Beads(Rows rows)>;

/// What this rank wants and has not, of so many words a bead; ascending.
Beads sent_by_others(const Ranks& ranks, const Layout& had, const Wanted& wanted, Eigen::Index words,
                     const PackedRows& packed);

/// Goes through wanted beads in their order: `keep` is called for those that are rows here, `take` for those
/// that come from others, with the place of the first among these; both with the row that it is to be.
void for_each_wanted(const std::vector<Stretch>& wanted, const std::vector<Stretch>& had,
                     const std::function<void(Rows rows, int to)>& keep,
                     const std::function<void(Rows columns, int to)>& take);

/// The jet with the beads that this rank wants as its rows, without a slope.
Jet<3> brought(const Ranks& ranks, const Jet<3>& jet, const Layout& had, const Wanted& wanted);

}  // namespace treejet
