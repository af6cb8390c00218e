#pragma once
/// The locally essential tree of one rank: the tree of its own piece of a chain, and grafted beside it what
/// the walk from its leaves may ask for of the other pieces.
///
///     tree.plant(piece, shape, threads);     the own tree, with moments
///     tree.graft(opening);                   ranks write each other what they need
///
/// First every rank shows all others its card: the root of its tree with moments, and an outline, a few balls
/// that hold its points. Then it writes to each rank whose outline is too near for the root alone: cells with
/// moments, opened down to the points where they are near. A piece is a stretch of the chain, so most others
/// are seen as one cell, its neighbours along the chain or between the turns of a coil in more detail.
///
/// Cells A and B are far if R_A + R_B < opening * |c_A - c_B| with critical radii (cells.hpp), which go by
/// the leaves of all pieces. A rank knows of another's leaf B no more than that it lies in a ball (c, r) of
/// its outline and that R_B <= rho, so it closes cell A for that ball if
///     R_A + rho < opening * (|c_A - c| - r) ;
/// then no leaf there asks for the children. Source: Warren and Salmon, Supercomputing '93. The fewer the
/// ranks, the longer their pieces and the more balls an outline has: cards stay small beside letters.
///
/// A piece may be empty. Memory: O(own points) + O(points received) + O(ranks) for the cards.

#include <vector>

#include "forces/coulomb/tree/cells.hpp"
#include "forces/coulomb/tree/passes.hpp"
#include "forces/coulomb/tree/tree_field.hpp"

namespace treejet {

class EssentialTree {
 public:
  /// Cells by number: the own ones as in Cells, then the grafted ones.
  struct Cell {
    double radius = 0, critical_radius = 0;
    int child = 0, children = 0;  ///< the first one, and how many; none: a leaf, or closed
    Rows points;                  ///< of a leaf
  };
  /// What the last grafting moved, counting the cards as a ring hands them on.
  struct Traffic {
    std::int64_t sent = 0, received = 0;      ///< bytes
    int cells = 0, points = 0, partners = 0;  ///< received; ranks that wrote more than their card
  };

  EssentialTree(const Ranks& ranks, Isa isa) : EssentialTree(ranks, ranks.size(), isa) {}
  /// As one of so many ranks, without them: to see what it would write.
  EssentialTree(const Ranks& ranks, int ranks_together, Isa isa);

  /// With `keep_order` points stand in the order found last time, if there are as many.
  void plant(const PointCharges<3>& piece, const TreeShape& shape, Threads threads, bool keep_order);
  /// Drops what was grafted before. Called by all ranks.
  void graft(double opening);

  /// Its two parts: what this rank shows all others, and what it writes to the one with that card, nothing if
  /// its own card is enough.
  using Message = std::vector<double>;
  Message card() const;
  Message letter(const double* card, double opening) const;

  const Cells& own() const { return own_; }
  /// One a piece that is not empty, the own one first.
  const std::vector<int>& roots() const { return roots_; }
  const Cell& cell(int k) const { return cells_[static_cast<std::size_t>(k)]; }
  double distance2(int a, int b) const;
  /// The points of the own leaf with this place among the leaves; all points, own and grafted, stand in the
  /// same arrays.
  CellPoints leaf(int k) const { return leaf_points(own_, points(), k); }
  CellPoints points() const;
  /// Where point k of the own tree stands in the caller's arrays.
  int source(int k) const { return order_.empty() ? k : order_[static_cast<std::size_t>(k)]; }

  /// Moments of all cells, local series of the own ones.
  Expansions& expansions() { return expansions_; }
  const Traffic& traffic() const { return traffic_; }
  std::int64_t bytes() const;  ///< held

  void visit(Archive& state) { state(order_, block_, leaf_); }

 private:
  /// Balls that hold a piece, for an opening: centres, and how far from a ball a cell of radius 0 must be to
  /// be far from all leaves in it, times the opening.
  struct BoundaryTree {
    double opening2 = 0;
    std::vector<double> centre[3], reach;
    void add(const double* ball, double opening);
  };

  std::size_t stride() const { return static_cast<std::size_t>(expansions_.moment_stride); }
  void view_expansions();
  void equalise_errors(double opening, const Cells::Spread& among, Threads threads);
  std::size_t root_on_card() const;
  std::size_t card_words() const;
  void write_outline(double* at) const;
  bool closed(int cell, const BoundaryTree& outline) const;
  void write(int cell, const BoundaryTree& outline, Message& letter) const;
  void write_cell(int cell, int children, int points, Message& letter) const;
  void make_room(const Ranks::Letters& letters);
  int place();
  const double* read(int cell, const double* at);
  void account(const Ranks::Letters& out, const Ranks::Letters& in);

  const WideKernels* kernels_;
  Ranks ranks_;
  int balls_;  ///< of an outline, at most
  Cells own_;
  std::vector<int> order_, roots_;
  int block_ = 0, leaf_ = 0;  ///< of the order
  bool even_ = true;
  std::vector<Cell> cells_;
  std::vector<double> centre_[3], history_, locals_, r_[3], q_;
  Expansions expansions_{};
  Traffic traffic_;
  std::int64_t letters_held_ = 0;
};

}  // namespace treejet
