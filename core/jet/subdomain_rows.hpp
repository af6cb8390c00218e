#pragma once
/// What a scheme that solves linear systems along a chain has to know of a chain held in subdomains, one on
/// each process (core/jet/decomposition.hpp).
///
/// Such a system has the own beads of a process as rows and one neighbour on either side where the chain goes
/// on: other rows than the jet, which has copies of the beads at the ends of the chain. All calls that send
/// are made by all processes in the same order.

#include <span>
#include <utility>
#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

template <int D>
class SubdomainRows {
 public:
  virtual ~SubdomainRows() = default;

  /// Rows of the system that are the own beads.
  virtual std::pair<Eigen::Index, Eigen::Index> own() const = 0;
  /// A table with a row a bead of the jet, as rows of the system; sends.
  virtual State<D> with_neighbours(const State<D>& table) const = 0;
  /// The own rows of the system into such a table, and the ends of the chain into that of all; sends.
  virtual void put_back(const State<D>& rows, State<D>& table) const = 0;

  /// Processes are counted along the chain.
  virtual int place() const = 0;
  /// The numbers of all processes, as many of each, in their order; sends.
  virtual std::vector<double> of_all(std::span<const double> own) const = 0;
};

}  // namespace treejet
