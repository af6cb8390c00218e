#pragma once
/// A chain in subdomains as a checkpoint has it (core/jet/decomposition.hpp): what all ranks know of it, and
/// behind that records of its beads, in their order. Whoever reads need not be in subdomains.

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"
#include "core/jet/jet.hpp"

namespace treejet {

/// A jet without its beads, and how it was cut.
template <int D>
struct SavedCut {
  Jet<D>& jet;
  Eigen::Index columns;      ///< of the state
  std::vector<int> borders;  ///< the first bead of each rank, and the number of all
  int recuts = 0;

  /// FileError if what is read is of no chain with so many columns.
  void visit(Archive& state) {
    const Eigen::Index expected = columns;
    state(jet.t, jet.held, jet.last_release, jet.removed, jet.born, columns, borders, recuts);
    if (columns != expected || borders.empty() || borders[0] != 0 || jet.removed < 0 ||
        !std::is_sorted(borders.begin(), borders.end()))
      throw FileError("the checkpoint's jet cannot be cut into subdomains");
  }
};

/// Some of its beads, with slopes, and what is carried along; `removed` counts those before them.
template <int D>
struct SavedBeads {
  Jet<D> jet;
  Eigen::ArrayXXd carried = Eigen::ArrayXXd(0, 0);

  void visit(Archive& state) { state(jet, carried); }
};

/// FileError unless these are `count` beads, with all that beads have.
template <int D>
void expect_complete(const SavedBeads<D>& saved, std::int64_t count, Eigen::Index columns) {
  const Jet<D>& jet = saved.jet;
  if (!complete(jet) || jet.size() != count || jet.slope.rows() != count || jet.y.cols() != columns ||
      jet.slope.cols() != columns)
    throw FileError("the checkpoint has beads without a mass, a charge, a volume or a velocity");
}

}  // namespace treejet
