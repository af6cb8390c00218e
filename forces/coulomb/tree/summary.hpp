#pragma once
/// What a subdomain, or several next to each other, show of themselves from afar: the balls of a boundary
/// tree, and all their points as one closed cell with moments. Empty without points.

#include <vector>

#include "forces/coulomb/tree/boundary_tree.hpp"
#include "forces/coulomb/tree/tree.hpp"

namespace treejet {

struct Summary {
  std::vector<Ball> balls;
  Ball whole = {};  ///< that of the cell
  double critical_radius = 0;
  std::vector<double> moments;

  bool empty() const { return balls.empty(); }
  /// Behind the words of a message.
  void write(std::vector<double>& message) const;
};

/// Of a rank's own points, in no more than so many balls.
Summary summary(const Tree& tree, int balls);

/// Of neighbours along the chain, the first of whom may have no points. The critical radius is as large
/// beside the radius as that of either: more careful than a cell of one tree, whose share shrinks with its
/// size.
Summary joined(const Summary& a, const Summary& b, int order, const WideKernels& kernels);

/// Whether each is far from all leaves of the other, so that one closed cell is all that they need of each
/// other; `of_a` is the boundary tree of a. The same whoever asks.
bool are_far(const Summary& a, const BoundaryTree& of_a, const Summary& b, double opening);

/// Reads what `write` has written, so many moments.
class SummaryReader {
 public:
  SummaryReader(const std::vector<double>& message, std::size_t moments)
      : at_(message.data()), moments_(moments) {}
  Summary next();

 private:
  const double* at_;
  std::size_t moments_;
};

}  // namespace treejet
