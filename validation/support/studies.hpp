#pragma once
/// The studies of treejet-validate. Each prints and writes its tables and adds its claims to the report.

#include "validation/support/deck_scaling.hpp"
#include "validation/support/report.hpp"

namespace treejet {

/// The paper's figures and tables, case by case.
void study_single_bead(Report& report);
void study_straight_jet(Report& report);
void study_pvp_jet(Report& report);

/// The paper's table of seconds per bead and step.
void study_performance(Report& report);

/// The spectrum of the whipping, in time and along the axis.
void study_whipping(Report& report);

/// The steady state of the PVP jet against the length of its elements.
void study_resolution(Report& report);

/// Point charges against the slender self-field, as elements get shorter.
void study_convergence(Report& report);

/// The same bytes on any number of ranks and threads.
void study_determinism(Report& report);

/// Error against work for every scheme on the paper's three cases; orders of convergence over insertions and
/// removals; error against tolerance.
void study_work_precision(Report& report);

/// Error of all beads of case 3, promised and measured, for every scheme and tolerance.
void study_promised_accuracy(Report& report);

/// The oldest bead where other programs say it is.
void study_reference_values(Report& report);

/// The paper's time-reversal test of its three schemes on case 1.
void study_time_reversal(Report& report);

/// The largest stable step of the explicit schemes where the fluid is stiff, and what then binds the
/// tolerance.
void study_stiffness(Report& report);

/// Runs killed at random moments and resumed, over and over: what is left after each death, and in the end.
void study_restart(Report& report);

/// Speedup and efficiency of ranks and threads on case 3 at several sizes, as in the paper's performance
/// section, and that none of them changes a bit of the answer.
void study_scaling(Report& report);

/// The same of a deck, with where the time goes: a table for a paper.
void study_scaling_of(const DeckScaling& asked, Report& report);

/// The field of a chain held in subdomains, one a rank: bytes, memory, accuracy, and a model of many ranks.
void study_distributed(Report& report);

/// Decks and states at the edge of what can be simulated: a right answer or a clear stop.
void study_extreme_cases(Report& report);

/// JETSPIN's example decks beside what their authors record, where the folder of decks is given.
void study_jetspin_records(Report& report);

/// The Coulomb field with nothing but the accuracy given; all shapes of the tree against the program's
/// choice.
void study_coulomb_accuracy(Report& report);

/// Crossover with the direct sum, and growth with the number of points.
void study_coulomb_cost(Report& report);

}  // namespace treejet
