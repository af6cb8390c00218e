#pragma once
/// Ranks: the processes that share one run, on one machine or on many.
///
/// Data are replicated: each rank holds everything and does the same arithmetic on it, but for tables whose
/// rows are shared out. Of such a table a rank sets its own rows, and `gather` gives every rank all of them;
/// what follows is again the same everywhere, bit for bit. Only the first rank writes files, and only it is
/// heard: the standard output of the others leads nowhere. Where a chain is held in subdomains instead
/// (forces/coulomb/tree/essential_tree.hpp), ranks write each other messages and take their
/// decisions from common sums.
///
/// A Ranks is a value. Copies stand for the same rank; a default one is alone and sends nothing. What sends
/// (join_ranks, gather, of_all, exchange, to_first, sum, times, agree, require_same, greatest, threads_each,
/// crowding) is called by all ranks in the same order, by their main threads. The only mpi.h is in
/// ranks_mpi.cpp; ranks_alone.cpp stands in for it where there is no MPI.

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "parallel/threads.hpp"

namespace treejet {

/// The ranks are not those that were started, or not fit to work together.
struct LaunchError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What gathering took so far: seconds of sending, and of waiting for those who came later.
struct GatherTimes {
  std::int64_t count = 0;
  double exchange = 0, wait = 0;
};

/// What a rank has sent since it joined: to single others, and its part in what all do together, counted as a
/// ring hands tables on. What MPI puts around it is not in it.
struct RankTraffic {
  std::int64_t messages = 0, message_bytes = 0;
  std::int64_t exchanges = 0;  ///< in each, every rank tells all others how long its message is
  std::int64_t tables = 0, table_bytes = 0;
  std::int64_t sums = 0, sum_bytes = 0;
  std::int64_t decisions = 0;  ///< greatest numbers, agreements: a word or two
};

/// "compute 1.2 s, exchange 0.1 s, wait 0.05 s ..." of a run that took so long; empty if nothing was sent.
std::string times_description(const GatherTimes& times, double seconds);

class Ranks {
 public:
  Ranks() = default;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool first() const { return rank_ == 0; }

  /// Equal shares of `rows` in whole blocks, counted from row 0: rank k owns borders[k] <= row <
  /// borders[k+1].
  std::vector<int> borders(Rows rows, int block) const;

  /// Each rank has set the rows of its own share of every column; now all have all.
  void gather(std::span<double* const> columns, const std::vector<int>& borders) const;

  /// The numbers of all ranks, of each as many, in the order of the ranks.
  std::vector<double> of_all(std::span<const double> own) const;

  /// One message to each rank, by its number; returned are those that came, by the number of the sender. An
  /// empty message is not sent.
  using Messages = std::vector<std::vector<double>>;
  Messages exchange(const Messages& to) const;

  /// A message to another rank, which receives it, be it empty; returns at once. Between two ranks messages
  /// arrive in the order in which they are sent. Nobody else takes part in either.
  void send(int to, std::vector<double> message) const;
  /// The next one from that rank; waits for it.
  std::vector<double> receive(int from) const;

  /// The bytes of rank `from`, on the first rank; these two take part, the others get back what
  /// they gave.
  std::string to_first(int from, std::string bytes) const;

  /// Each number becomes the sum of all ranks' numbers in its place, to the same bits on all ranks.
  void sum(std::span<double> numbers) const;

  /// The mean over the ranks.
  GatherTimes times() const;

  /// Of this rank alone.
  RankTraffic traffic() const;

  /// Whether all ranks have the same text.
  bool agree(const std::string& text) const;

  /// LaunchError unless all ranks run the same program on the same deck: else they would drift apart.
  void require_same(const std::string& program, const std::string& deck) const;

  /// The greatest of the ranks' numbers.
  int greatest(int number) const;
  double greatest(double number) const;

  /// Threads for each rank so that those on a node do not take each other's cores.
  int threads_each() const;
  /// A warning if ranks have more threads than cores of their own, on the first rank; else empty.
  std::string crowding(Threads threads) const;

  /// Ends this rank because of an error, and with it all others: returns the exit code once all have failed,
  /// or else does not return. The message is printed once.
  int fail(int exit_code, const std::string& message) const;

 private:
  struct World;
  /// Threads that are confined to the cores of a rank.
  struct Crowd {
    int threads, cores;
  };
  friend Ranks join_ranks();

  std::vector<Crowd> crowds(Threads threads) const;  ///< one a rank

  int rank_ = 0, size_ = 1;
  std::shared_ptr<World> world_;  ///< left when the last copy goes; null if alone
};

/// The ranks that mpirun or srun has started; one that is alone, at no cost, if neither has. LaunchError if
/// they cannot find each other.
Ranks join_ranks();

}  // namespace treejet
