#pragma once
/// A model of the time that the field of a chain held in pieces takes on many ranks: what this machine cannot
/// measure, from what it can.
///
///     T(N, P) = a N / P  +  b (P - 1)  +  latency * messages  +  bytes / bandwidth ,
///
/// a: seconds a point, measured on one rank. b: seconds a rank seen from afar, for looking at its card,
/// measured here. Messages and bytes of a rank are counted, not guessed: one process makes the cards of all P
/// pieces and the letters that the pieces in the middle and at the end of the chain write. Not in the model:
/// imbalance of the pieces, contention of the network, work at cells received (the study's tables show it),
/// everything in a step but the field.

#include "validation/support/distributed_run.hpp"

namespace treejet {

/// Of one rank and evaluation; the greater one of the ranks looked at.
struct Volume {
  double partners = 0, letters = 0,
         cards = 0;           ///< ranks written to; bytes written to them; bytes of all cards
  double seconds_a_card = 0;  ///< for looking at the cards of the others
};

Volume volume(const LongChain& chain, int points, int ranks, const TreeShape& shape);

struct ScalingModel {
  double seconds_a_point, seconds_a_card;
  double latency = 2e-6;    ///< s a message: a common fabric's, assumed
  double bandwidth = 10e9;  ///< bytes/s of a rank: a common fabric's, assumed

  double seconds(double points, double ranks, const Volume& v) const;
  double messages(double ranks, const Volume& v) const;
};

}  // namespace treejet
