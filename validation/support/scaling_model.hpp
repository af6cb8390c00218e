#pragma once
/// A model of the time that the field of a chain held in subdomains takes on many ranks: what this machine
/// cannot measure, from what it can.
///
///     T(N, P) = a N / P  +  b (P - 1)  +  latency * messages  +  bytes / bandwidth ,
///
/// a: seconds a point, measured on one rank. b: seconds a rank seen from afar, for looking at its summary,
/// measured here. Messages and bytes of a rank are counted, not guessed (rank_volume.hpp): one process makes
/// the summaries of all P subdomains and the messages that those in the middle and at the end of the chain
/// send. On few ranks they are to the byte what ranks count themselves, which study and tests check. Not in
/// the model: imbalance of the subdomains, contention of the network, work at cells received (the study's
/// tables show it), everything in a step but the field.

#include "validation/support/distributed_run.hpp"

namespace treejet {

/// Of one rank and evaluation; the greater one of the ranks looked at.
struct Volume {
  double partners = 0, messages = 0;  ///< ranks sent to; bytes sent to them
  RankTraffic common;                 ///< what all ranks do together
  double seconds_a_summary = 0;       ///< for looking at the summaries of the others
};

Volume volume(const LongChain& chain, int points, int ranks, const TreeShape& shape);

struct ScalingModel {
  double seconds_a_point, seconds_a_summary;
  double latency = 2e-6;    ///< s a message: a common fabric's, assumed
  double bandwidth = 10e9;  ///< bytes/s of a rank: a common fabric's, assumed

  /// Of it for what grows with the number of ranks: summaries looked at, lengths of messages told.
  double seconds_for_cards(double ranks, const Volume& v) const;
  double seconds(double points, double ranks, const Volume& v) const;
  double messages(double ranks, const Volume& v) const;
};

}  // namespace treejet
