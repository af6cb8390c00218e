/// The twin of ranks_mpi.cpp without MPI: there is one rank.

#include <cstdio>

#include "parallel/launch.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

struct Ranks::World {};

Ranks join_ranks() {
  if (launch().ranks != 1)
    throw LaunchError(
        "started as several ranks, but this program was built without MPI; build it with one, "
        "or start it without mpirun and srun");
  return {};
}

void Ranks::gather(std::span<double* const>, const std::vector<int>&) const {}

Ranks::Messages Ranks::exchange(const Messages& to) const {
  return to;
}

void Ranks::send(int, std::vector<double>) const {
  throw std::logic_error("there is no other rank");
}

std::vector<double> Ranks::receive(int) const {
  throw std::logic_error("there is no other rank");
}

std::string Ranks::to_first(int, std::string bytes) const {
  return bytes;
}

void Ranks::sum(std::span<double>) const {}

GatherTimes Ranks::times() const {
  return {};
}

RankTraffic Ranks::traffic() const {
  return {};
}

bool Ranks::agree(const std::string&) const {
  return true;
}

int Ranks::greatest(int number) const {
  return number;
}

double Ranks::greatest(double number) const {
  return number;
}

int Ranks::threads_each() const {
  return threads_named().value_or(available_cores());
}

std::vector<Ranks::Crowd> Ranks::crowds(Threads threads) const {
  return {{threads.count, available_cores()}};
}

int Ranks::fail(int exit_code, const std::string& message) const {
  if (launch().rank == 0) std::fputs(message.c_str(), stderr);
  return exit_code;
}

}  // namespace treejet
