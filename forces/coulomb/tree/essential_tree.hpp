#pragma once
/// The locally essential tree of one rank: beside the tree of its own subdomain of a chain stands, grafted,
/// what the walk from its leaves may ask for of the other subdomains.
///
///     others.graft(tree, shape, kernels);     ranks send each other what they need
///
/// Most of the others are far and are seen as few closed cells, of groups of ranks (summary_tree.hpp). A
/// rank that is near gets a message: cells with moments, opened down to the points where they are near to the
/// boundary tree of the rank that reads it (boundary_tree.hpp). A subdomain is a stretch of the chain, so
/// those are its neighbours along the chain and between the turns of a coil. Cells are far by their critical
/// radii (cells.hpp), which go by the leaves of all subdomains.
///
/// A subdomain may be empty. Memory: O(own points) + O(points received) + O(log ranks) for the summaries.

#include <vector>

#include "forces/coulomb/tree/summary_tree.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

class EssentialTree {
 public:
  using Message = std::vector<double>;
  /// What the last grafting moved.
  struct Traffic {
    std::int64_t sent = 0, received = 0;      ///< bytes
    int cells = 0, points = 0, partners = 0;  ///< received; ranks that sent more than their summary
  };

  explicit EssentialTree(const Ranks& subdomains)
      : ranks_(subdomains), summaries_(subdomains.rank(), subdomains.size()) {}

  /// Grafts the other subdomains, in place of what was grafted before. Called by all ranks; nothing if there
  /// is one.
  void graft(Tree& tree, const TreeShape& shape, const WideKernels& kernels);

  /// What one of so many ranks shows of its own points at first.
  static Summary own_summary(const Tree& tree, int ranks);
  /// What it sends a rank that is near: nothing if its summary is enough.
  static Message message(const Tree& tree, const Summary& reader, double opening);

  const Traffic& traffic() const { return traffic_; }
  std::int64_t bytes() const { return bytes_; }  ///< of messages, held at the most

 private:
  void exchange_summaries();
  void send(int to, const Message& message);
  Message receive(int from);

  Ranks ranks_;
  SummaryTree summaries_;
  Traffic traffic_;
  std::int64_t bytes_ = 0;
};

}  // namespace treejet
