#pragma once
/// A model of the time that the field of a chain held in subdomains takes on many ranks: what this machine
/// cannot measure, from what it can.
///
///     T(N, P) = a N / P  +  b(P)  +  latency * messages  +  bytes / bandwidth ,
///
/// a: seconds a point, measured on one rank. b: seconds for looking at the summaries that a rank meets, and
/// for joining its own, measured here. Messages and bytes of a rank are counted, not guessed
/// (rank_volume.hpp): one process makes the summaries of all groups of the P subdomains and sends what ranks
/// in the middle and at the end of the chain would. On few ranks they are to the byte what ranks count
/// themselves, which study and tests check. Not in the model: imbalance of the subdomains, contention of the
/// network, work at cells received (the study's tables show it), everything in a step but the field.

#include "validation/support/distributed_run.hpp"

namespace treejet {

/// Of one rank and evaluation; the greater one of the ranks looked at.
struct Volume {
  RankTraffic summaries;              ///< until all know who is near
  double partners = 0, messages = 0;  ///< ranks then written to; bytes
  double seconds_for_summaries = 0;
};

Volume volume(const LongChain& chain, int points, int ranks, const TreeShape& shape);

struct ScalingModel {
  double seconds_a_point;
  double latency = 2e-6;    ///< s a message: a common fabric's, assumed
  double bandwidth = 10e9;  ///< bytes/s of a rank: a common fabric's, assumed

  /// Of it for what goes by the number of ranks: summaries, how many and how large.
  double seconds_for_summaries(const Volume& v) const;
  double seconds(double points, double ranks, const Volume& v) const;
  double messages(double ranks, const Volume& v) const;
};

}  // namespace treejet
