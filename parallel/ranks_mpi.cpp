#include <fcntl.h>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <list>
#include <stdexcept>
#include <thread>

#include "parallel/launch.hpp"
#include "parallel/ranks.hpp"
#include "parallel/work_clock.hpp"

namespace treejet {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::int64_t bytes_of(std::size_t words) {
  return static_cast<std::int64_t>(words * sizeof(double));
}

/// What MPI counts in int.
int counted(std::size_t words) {
  if (words > std::size_t{std::numeric_limits<int>::max()})
    throw std::length_error("a message between ranks has more than 2^31 words; more ranks share them");
  return static_cast<int>(words);
}

/// One message for each rank: its rows of all columns, and how long it spent on the gathering before.
struct Message {
  std::vector<int> counts, places;
  std::vector<double> values;

  void arrange(int columns, const std::vector<int>& borders) {
    counts.clear();
    places.clear();
    std::size_t place = 0;
    for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
      const std::size_t rows = index(borders[k + 1] - borders[k]), words = index(columns) * rows + 1;
      counts.push_back(counted(words));
      places.push_back(counted(place));
      place += words;
    }
    values.resize(place);
  }
  double* of(std::size_t rank) { return values.data() + places[rank]; }
  double& last_word(std::size_t rank) { return of(rank)[counts[rank] - 1]; }
};

/// A message that has been sent and may not have been received.
struct UnderWay {
  std::vector<double> message;
  MPI_Request request;

  bool done() {
    int done;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  }
};

/// What messages are for: those of `to_first` and of `send` do not mix with the others.
enum Tag { of_exchange, to_the_first, sent_alone };

/// The cores that a rank may run on and the threads it runs there.
struct Berth {
  CoreSet cores;
  int threads;
};

}  // namespace

struct Ranks::World {
  MPI_Comm everyone = MPI_COMM_NULL, failed = MPI_COMM_NULL, node = MPI_COMM_NULL;
  Message message;
  std::list<UnderWay> under_way;
  GatherTimes times;
  RankTraffic traffic;
  double last = 0;  ///< seconds of the last gathering

  World() {
    int level;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_dup(MPI_COMM_WORLD, &everyone);
    MPI_Comm_dup(MPI_COMM_WORLD, &failed);
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    for (MPI_Comm* c : {&everyone, &failed, &node}) MPI_Comm_free(c);
    MPI_Finalize();
  }

  /// Of all ranks on this node.
  std::vector<Berth> berths(Threads threads) const {
    int count;
    MPI_Comm_size(node, &count);
    std::vector<Berth> all(static_cast<std::size_t>(count));
    const Berth mine = {cores_of_this_process(), threads.count};
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, node);
    return all;
  }
};

Ranks join_ranks() {
  const Launch launched = launch();
  if (launched.ranks == 1) return {};
  Ranks ranks;
  ranks.world_ = std::make_shared<Ranks::World>();
  MPI_Comm_rank(ranks.world_->everyone, &ranks.rank_);
  MPI_Comm_size(ranks.world_->everyone, &ranks.size_);
  if (launched.ranks > 0 && ranks.size_ != launched.ranks)
    throw LaunchError(
        fmt::format("{} ranks were started, but MPI sees {}: the launcher is not that of the MPI library "
                    "this program was "
                    "built with; with srun, try --mpi=pmix",
                    launched.ranks, ranks.size_));
  if (!ranks.first()) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
  return ranks;
}

void Ranks::gather(std::span<double* const> columns, const std::vector<int>& borders) const {
  if (size_ == 1) return;
  const Working at(Work::exchange);
  const auto begin = Clock::now();
  Message& m = world_->message;
  const auto me = static_cast<std::size_t>(rank_);
  m.arrange(static_cast<int>(columns.size()), borders);
  double* out = m.of(me);
  for (const double* column : columns) out = std::copy(column + borders[me], column + borders[me + 1], out);
  m.last_word(me) = world_->last;
  ++world_->traffic.tables;
  world_->traffic.table_bytes += bytes_of(m.values.size() - static_cast<std::size_t>(m.counts[me]));

  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, m.values.data(), m.counts.data(), m.places.data(),
                 MPI_DOUBLE, world_->everyone);

  double quickest = m.last_word(0);
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    quickest = std::min(quickest, m.last_word(k));
    if (k == me) continue;
    const double* in = m.of(k);
    const int rows = borders[k + 1] - borders[k];
    for (double* column : columns) {
      std::copy_n(in, rows, column + borders[k]);
      in += rows;
    }
  }
  // Who came last did not wait; that time is the exchange proper, what others spent beyond it is waiting.
  ++world_->times.count;
  world_->times.exchange += quickest;
  world_->times.wait += world_->last - quickest;
  world_->last = seconds_since(begin);
}

/// Messages and sums count as exchange; how much of it is waiting nobody tells.
Ranks::Messages Ranks::exchange(const Messages& to) const {
  if (size_ == 1) return to;
  const Working at(Work::exchange);
  const auto begin = Clock::now();
  const MPI_Comm comm = world_->everyone;
  std::vector<int> out(to.size()), in(to.size());
  for (std::size_t k = 0; k < to.size(); ++k) out[k] = counted(to[k].size());
  MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, comm);
  ++world_->traffic.exchanges;
  Messages from(to.size());
  std::vector<MPI_Request> under_way;
  for (std::size_t k = 0; k < to.size(); ++k) {
    const int other = static_cast<int>(k);
    if (other == rank_) {
      from[k] = to[k];
      continue;
    }
    from[k].resize(static_cast<std::size_t>(in[k]));
    if (in[k] > 0)
      MPI_Irecv(from[k].data(), in[k], MPI_DOUBLE, other, of_exchange, comm, &under_way.emplace_back());
    if (out[k] == 0) continue;
    MPI_Isend(to[k].data(), out[k], MPI_DOUBLE, other, of_exchange, comm, &under_way.emplace_back());
    ++world_->traffic.messages;
    world_->traffic.message_bytes += bytes_of(to[k].size());
  }
  MPI_Waitall(static_cast<int>(under_way.size()), under_way.data(), MPI_STATUSES_IGNORE);
  world_->times.exchange += seconds_since(begin);
  return from;
}

void Ranks::send(int to, std::vector<double> message) const {
  const Working at(Work::exchange);
  std::list<UnderWay>& under_way = world_->under_way;
  under_way.remove_if([](UnderWay& sent) { return sent.done(); });
  under_way.push_back({std::move(message), MPI_REQUEST_NULL});
  UnderWay& sent = under_way.back();
  MPI_Isend(sent.message.data(), counted(sent.message.size()), MPI_DOUBLE, to, sent_alone, world_->everyone,
            &sent.request);
  ++world_->traffic.messages;
  world_->traffic.message_bytes += bytes_of(sent.message.size());
}

std::vector<double> Ranks::receive(int from) const {
  const Working at(Work::exchange);
  const auto begin = Clock::now();
  MPI_Status status;
  int count;
  MPI_Probe(from, sent_alone, world_->everyone, &status);
  MPI_Get_count(&status, MPI_DOUBLE, &count);
  std::vector<double> message(static_cast<std::size_t>(count));
  MPI_Recv(message.data(), count, MPI_DOUBLE, from, sent_alone, world_->everyone, MPI_STATUS_IGNORE);
  world_->times.exchange += seconds_since(begin);
  return message;
}

/// Nobody sends before the first rank asks: what arrives unasked for would pile up there.
std::string Ranks::to_first(int from, std::string bytes) const {
  if (from == 0 || (rank_ != 0 && rank_ != from)) return bytes;
  const Working at(Work::exchange);
  const auto begin = Clock::now();
  const MPI_Comm comm = world_->everyone;
  if (rank_ == from) {
    MPI_Ssend(bytes.data(), counted(bytes.size()), MPI_CHAR, 0, to_the_first, comm);
    ++world_->traffic.messages;
    world_->traffic.message_bytes += static_cast<std::int64_t>(bytes.size());
  } else {
    MPI_Status status;
    int count;
    MPI_Probe(from, to_the_first, comm, &status);
    MPI_Get_count(&status, MPI_CHAR, &count);
    bytes.resize(static_cast<std::size_t>(count));
    MPI_Recv(bytes.data(), count, MPI_CHAR, from, to_the_first, comm, MPI_STATUS_IGNORE);
  }
  world_->times.exchange += seconds_since(begin);
  return bytes;
}

/// Not by Allreduce, which may add in another order on each rank.
void Ranks::sum(std::span<double> numbers) const {
  if (size_ == 1) return;
  const Working at(Work::exchange);
  const auto begin = Clock::now();
  const MPI_Comm comm = world_->everyone;
  ++world_->traffic.sums;
  world_->traffic.sum_bytes += bytes_of(numbers.size());
  const int count = static_cast<int>(numbers.size());
  MPI_Reduce(first() ? MPI_IN_PLACE : numbers.data(), numbers.data(), count, MPI_DOUBLE, MPI_SUM, 0, comm);
  MPI_Bcast(numbers.data(), count, MPI_DOUBLE, 0, comm);
  world_->times.exchange += seconds_since(begin);
}

GatherTimes Ranks::times() const {
  if (!world_) return {};
  GatherTimes mean = world_->times;
  for (double* seconds : {&mean.exchange, &mean.wait}) {
    MPI_Allreduce(MPI_IN_PLACE, seconds, 1, MPI_DOUBLE, MPI_SUM, world_->everyone);
    *seconds /= size_;
  }
  return mean;
}

RankTraffic Ranks::traffic() const {
  return world_ ? world_->traffic : RankTraffic();
}

bool Ranks::agree(const std::string& text) const {
  if (size_ == 1) return true;
  ++world_->traffic.decisions;
  const std::uint64_t mine = std::hash<std::string>{}(text);
  std::uint64_t bounds[2] = {mine, ~mine};
  MPI_Allreduce(MPI_IN_PLACE, bounds, 2, MPI_UINT64_T, MPI_MAX, world_->everyone);
  return bounds[0] == ~bounds[1];
}

int Ranks::greatest(int number) const {
  if (size_ == 1) return number;
  const Working at(Work::exchange);
  ++world_->traffic.decisions;
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT, MPI_MAX, world_->everyone);
  return number;
}

double Ranks::greatest(double number) const {
  if (size_ == 1) return number;
  const Working at(Work::exchange);
  ++world_->traffic.decisions;
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_DOUBLE, MPI_MAX, world_->everyone);
  return number;
}

int Ranks::threads_each() const {
  if (const auto named = threads_named()) return *named;
  if (!world_) return available_cores();
  const CoreSet mine = cores_of_this_process();
  int sharers = 0;
  for (const Berth& b : world_->berths({})) sharers += (b.cores & mine).any();
  return std::max(1, static_cast<int>(mine.count()) / std::max(1, sharers));
}

std::vector<Ranks::Crowd> Ranks::crowds(Threads threads) const {
  if (!world_) return {{threads.count, available_cores()}};
  const CoreSet mine = cores_of_this_process();
  Crowd here = {0, static_cast<int>(mine.count())};
  for (const Berth& b : world_->berths(threads))
    if ((b.cores & ~mine).none()) here.threads += b.threads;
  std::vector<Crowd> all(static_cast<std::size_t>(size_));
  MPI_Allgather(&here, sizeof here, MPI_BYTE, all.data(), sizeof here, MPI_BYTE, world_->everyone);
  return all;
}

/// An error of all ranks (a wrong deck, a jet gone wrong) ends them in good order, the first one speaking.
/// One that others do not share finds them waiting in a gathering, where only MPI_Abort reaches them; the
/// launcher then adds lines of its own.
int Ranks::fail(int exit_code, const std::string& message) const {
  if (size_ > 1) {
    MPI_Request all_failed;
    int done = 0;
    MPI_Ibarrier(world_->failed, &all_failed);
    const auto begin = Clock::now();
    // the first rank loses patience first, so that no other speaks where it will
    const double patience = first() ? 1 : 3 + 0.1 * std::min(rank_, 100);
    while (!done && seconds_since(begin) < patience) {
      MPI_Test(&all_failed, &done, MPI_STATUS_IGNORE);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (!done) {
      std::fputs(message.c_str(), stderr);
      std::fflush(stderr);
      MPI_Abort(MPI_COMM_WORLD, exit_code);
    }
  }
  if (first()) std::fputs(message.c_str(), stderr);
  return exit_code;
}

}  // namespace treejet
