#pragma once
/// The locally essential tree of one rank: beside the tree of its own subdomain of a chain stands, grafted,
/// what the walk from its leaves may ask for of the other subdomains.
///
///     others.graft(tree, opening);     ranks send each other what they need
///
/// First every rank sends all others its summary: the root of its tree with moments, and a boundary tree, a
/// few balls that hold its points. Then it sends a message to each rank whose boundary tree is too near for
/// the root alone: cells with moments, opened down to the points where they are near. A subdomain is a
/// stretch of the chain, so most others are seen as one cell, its neighbours along the chain or between the
/// turns of a coil in more detail.
///
/// Cells A and B are far if R_A + R_B < opening * |c_A - c_B| with critical radii (cells.hpp), which go by
/// the leaves of all subdomains. A rank knows of another's leaf B no more than that it lies in a ball (c, r)
/// of its boundary tree and that R_B <= rho, so it closes cell A for that ball if
///     R_A + rho < opening * (|c_A - c| - r) ;
/// then no leaf there asks for the children. Source: Warren and Salmon, Supercomputing '93. The fewer the
/// ranks, the longer their subdomains and the more balls a boundary tree has: summaries stay small beside
/// messages.
///
/// A subdomain may be empty. Memory: O(own points) + O(points received) + O(ranks) for the summaries.

#include <vector>

#include "forces/coulomb/tree/tree.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

class EssentialTree {
 public:
  using Message = std::vector<double>;
  /// What the last grafting moved, counting the summaries as a ring hands them on.
  struct Traffic {
    std::int64_t sent = 0, received = 0;      ///< bytes
    int cells = 0, points = 0, partners = 0;  ///< received; ranks that sent more than their summary
  };

  explicit EssentialTree(const Ranks& subdomains) : EssentialTree(subdomains, subdomains.size()) {}
  /// As one of so many ranks, without them: to see what it would send.
  explicit EssentialTree(int ranks_together) : EssentialTree({}, ranks_together) {}

  /// Grafts the other subdomains, in place of what was grafted before. Called by all ranks; nothing if there
  /// is one.
  void graft(Tree& tree, double opening);

  /// Its two parts: what this rank sends all others, and what it sends the one with that summary, nothing if
  /// its own summary is enough.
  Message summary(const Tree& tree) const;
  Message message(const Tree& tree, const double* summary, double opening) const;

  const Traffic& traffic() const { return traffic_; }
  std::int64_t bytes() const { return bytes_; }  ///< of messages, held at the most

 private:
  EssentialTree(const Ranks& subdomains, int ranks_together);

  std::size_t root_in_summary() const;
  std::size_t summary_words(const Tree& tree) const;
  void account(const Tree& tree, const Ranks::Messages& out, const Ranks::Messages& in);

  Ranks ranks_;
  int balls_;  ///< of a boundary tree, at most
  Traffic traffic_;
  std::int64_t bytes_ = 0;
};

}  // namespace treejet
