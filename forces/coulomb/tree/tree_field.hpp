#pragma once
/// The Coulomb field of charges by a tree of a given shape: what to compute, not how well (coulomb_solver.hpp
/// chooses the shape from an accuracy).
///
///     tree.arrange(points, shape, threads);              order of the points, cells, moments
///     tree.evaluate(leaves, rows, field, threads);       the field at points of the leaves
///
/// Moments go up (P2M, M2M), across to far cells (M2L), down (L2L) and out (L2P); near leaves act point by
/// point (P2P). The shape without local expansions is barnes_hut.hpp. A target cell's sums depend on the
/// points and the shape only, not on which other targets are wanted or who computes them: one thread does, in
/// one order. Source: Dehnen, J. Comput. Phys. 179 (2002) 27.
///
/// Ranks work together in one of two ways (TreeRanks). Either each holds all points and computes the leaves
/// of its share: the bits are those of one rank. Or each holds a subdomain and computes the field at its own
/// points, beside its own tree standing what it needs of the others (essential_tree.hpp): same condition for
/// far cells, same order of expansion, hence the same accuracy, but bits that depend on the subdomains. A
/// subdomain may be empty. One rank is the case of either in which there are no others.

#include <span>
#include <vector>

#include "core/base/archive.hpp"
#include "forces/coulomb/tree/essential_tree.hpp"
#include "forces/coulomb/tree/interactions.hpp"
#include "forces/coulomb/tree/tree.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

/// Ranks that hold all points alike and share out the leaves, or ranks that hold a subdomain each.
struct TreeRanks {
  Ranks sharing = {}, subdomains = {};
};

class TreeField {
 public:
  explicit TreeField(Isa isa = default_isa(), const TreeRanks& ranks = {})
      : isa_(isa), kernels_(&wide_kernels(isa)), ranks_(ranks), others_(ranks.subdomains) {}

  /// With `keep_order` the order found last time serves again, if the number of points and the shape allow
  /// it: right for any points, best while they hardly move. Called by all ranks, as are its parts and
  /// `reshape`.
  void arrange(const PointCharges<3>& points, const TreeShape& shape, Threads threads,
               bool keep_order = false) {
    place(points, shape, threads, keep_order);
    expand(threads);
  }
  /// Its two parts: the own points and cells, which are all that `count` needs, though in subdomains it then
  /// sees nothing of the others; moments, and what is seen of the others.
  void place(const PointCharges<3>& points, const TreeShape& shape, Threads threads, bool keep_order = false);
  void expand(Threads threads);
  /// The same points in the same leaves; another order of expansion, opening or precision.
  void reshape(const TreeShape& shape, Threads threads);

  Isa isa() const { return isa_; }
  const TreeRanks& ranks() const { return ranks_; }
  bool in_subdomains() const { return ranks_.subdomains.size() > 1; }
  const TreeShape& shape() const { return shape_; }
  const Tree& tree() const { return tree_; }
  int points() const { return tree_.points.size(); }  ///< the own ones
  int leaves() const { return tree_.cells.leaves(); }
  /// The leaves that hold points of `rows`.
  std::vector<int> leaves_of(Rows rows) const;

  /// Writes the field, and the potential if there is a place for it, at the points of the given leaves
  /// (ascending) that lie in `rows`. With the potential the near field is in double precision. What is done
  /// is told of this rank.
  Interactions evaluate(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                        Threads threads, double* potential = nullptr);
  /// Leaves it in `sums`: three components by the tree's order of points, and the potential.
  Interactions sum(const std::vector<int>& leaves, Threads threads, bool potential = false);
  std::array<std::span<const double>, 3> sums() const { return tree_.points.field_sums(); }

  /// What `evaluate` would do for all points, with M2L counted in full registers; no sums are done.
  Interactions count() const;

  /// What subdomains cost: messages of the last arrangement, and bytes held in all.
  const EssentialTree::Traffic& traffic() const { return others_.traffic(); }
  std::int64_t bytes() const;

  /// What `keep_order` keeps.
  void visit(Archive& state);

 private:
  struct Task;

  void equalise_errors(Threads threads);
  std::span<const int> own_share(const std::vector<int>& leaves) const;
  void gather(const std::vector<int>& leaves, std::size_t sums);
  Interactions local_expansions(std::span<const int> leaves, bool potential, Threads threads);
  Interactions barnes_hut(std::span<const int> leaves, bool potential, Threads threads);
  std::vector<Task> tasks(Threads threads) const;
  void act_near(int leaf, std::span<const int> near, bool potential);

  Isa isa_;
  const WideKernels* kernels_;
  TreeRanks ranks_;
  TreeShape shape_;
  Tree tree_;
  EssentialTree others_;
  std::vector<char> wanted_;
};

}  // namespace treejet
