#include "forces/coulomb/solver/autotune.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/tree_parameters.hpp"
#include "forces/coulomb/solver/sample.hpp"

namespace treejet {

namespace {

/// Below this accuracy a near field in single precision is not tried.
constexpr double finest_single = 3e-5;
constexpr double widest_opening = 0.8, narrowest_opening = 0.05, opening_step = 0.93;
/// A leaf. Of subdomains of a few points a tree is no cheaper than the direct sum, and one that moves and
/// grows by a bead errs by many times the accuracy before it is measured again.
constexpr int least_points_of_a_rank = 32;

/// Points that move may come to share a leaf with some far off, on whose scale they are one in single
/// precision; on a chain they do not. Subdomains do without.
bool single_serves(const CoulombRequest& request, const TreeField& tree, int block) {
  return !tree.in_subdomains() && request.accuracy >= finest_single && !(request.points_move && block > 0);
}

TunedShape direct_because(const std::string& reason) {
  TunedShape choice;
  choice.reason = reason;
  return choice;
}

}  // namespace

/// Measured on jets and coils.
int usual_order(double accuracy) {
  return std::clamp(static_cast<int>(std::lround(-1.35 * std::log10(accuracy))), 3, 13);
}

double cost(const Interactions& work, const TreeShape& shape, int points, Isa isa) {
  // an M2L of order 2, 3, ..., 14; measured, and so is the rest
  constexpr double wide[] = {20, 30, 40, 57, 80, 115, 160, 225, 320, 410, 520, 680, 860};
  constexpr double narrow[] = {13, 21, 30, 46, 70, 95, 131, 175, 240, 323, 410, 530, 690};
  constexpr double plain[] = {13, 22, 31, 50, 80, 119, 180, 263, 414, 632, 813, 1066, 1618};
  const double p = shape.order, n = points;
  const double expansion = (isa == Isa::avx512 ? wide : isa == Isa::avx2 ? narrow : plain)[shape.order - 2];
  const double point = 40 + 1.25 * p * p;  // P2M, L2P, copies
  const double leaf = 2 * p * p * p;       // M2M and L2L
  const double sort = shape.block == 0 ? 0 : 10 + 150.0 / shape.block;
  const double pair = shape.single ? 0.5 : 1;
  return pair * static_cast<double>(work.pairs) + expansion * static_cast<double>(work.expansions) +
         (point + sort) * n + leaf * n / shape.leaf;
}

/// Fits what `treejet-validate coulomb` measures on whipping jets: 350, 1300, 1800, 3600 points at accuracy
/// 1e-3, 1e-5, 1e-7, 1e-9 with AVX-512. Coils cross over earlier; then the tree is worth little as well.
int direct_below(double accuracy, Isa isa) {
  const double digits = std::clamp(-std::log10(accuracy), 2.0, 12.0);
  return static_cast<int>((isa == Isa::avx512 ? 40 : 30) * digits * digits);
}

namespace {

/// The price of this work, of the rank that has most of it.
double greatest_cost(const Interactions& work, const TreeField& tree) {
  return tree.ranks().subdomains.greatest(cost(work, tree.shape(), tree.points(), tree.isa()));
}

/// Chain or space: the order of points with the least work at this shape, with one opening for all cells:
/// evened out it goes by the mean leaf, which is another in each order. Long subdomains are looked at each by
/// itself: in an order that suits the chain ill, they would show each other nearly all they hold.
TreeShape cheapest_order(const PointCharges<3>& points, int all, const CoulombRequest& request,
                         TreeShape shape, TreeField& tree, Threads threads) {
  constexpr double long_subdomain = 4096;
  const bool alone = !tree.in_subdomains() || all >= long_subdomain * tree.ranks().subdomains.size();
  TreeShape tried = shape;
  tried.even = false;
  double least = std::numeric_limits<double>::infinity();
  for (int block : {0, 16, 4, 1}) {
    if (request.space && *request.space != (block > 0)) continue;
    tried.block = block;
    tried.single = single_serves(request, tree, block);
    tree.place(points, tried, threads);
    if (!alone) tree.expand(threads);
    const double work = greatest_cost(tree.count(), tree);
    if (work < least) {
      least = work;
      shape.block = block;
    }
  }
  return shape;
}

/// The search for the cheapest shape that is accurate enough.
struct Search {
  const PointCharges<3>& points;
  const CoulombRequest& request;
  TreeField& tree;
  Threads threads;
  TunedShape best{};

  /// The widest opening that is accurate enough at each of these orders, from a bit wider than `widest` down.
  void try_orders(const TreeShape& shape, std::span<const int> orders, double widest) {
    tree.arrange(points, shape, threads);
    const CoulombSample sample(tree, threads);
    for (int order : orders)
      if (tree_parameters::is_order(order)) try_openings(order, sample, widest);
  }

  void try_openings(int order, const CoulombSample& sample, double widest) {
    // in subdomains an opening much narrower than that of a shape already found would cost more than the
    // order saves, and show every rank much of the others
    const double narrowest =
        tree.in_subdomains() && !best.direct ? 0.6 * best.shape.opening : narrowest_opening;
    const bool pinned = request.opening.has_value();
    TreeShape shape = tree.shape();
    shape.order = order;
    shape.opening = request.opening.value_or(widest);
    for (; shape.opening > narrowest; shape.opening *= opening_step) {
      tree.reshape(shape, threads);
      const SampledError error = sample.error(tree, threads);
      if (error.bound <= request.accuracy || (pinned && request.order)) return consider(error);
      if (pinned) return;
    }
  }

  void consider(const SampledError& error) {
    // if all pairs are near this is a direct sum in disguise, whose error tells nothing of the shape
    const Interactions counted = tree.count();
    const bool far = tree.ranks().subdomains.greatest(counted.expansions > 0 ? 1 : 0) > 0;
    if (!far && !request.opening) return;
    const double work = greatest_cost(counted, tree);
    if (work < best.work) best = {false, {}, tree.shape(), error, work};
  }
};

/// The order of expansion about the usual one, and what goes beyond the plain tree: near fields in single
/// precision and other leaves, which subdomains do without.
void search_all(Search& search, TreeShape shape) {
  const CoulombRequest& request = search.request;
  const bool whole = !search.tree.in_subdomains();
  const int usual = shape.order;
  std::vector<int> orders = {usual, usual + 1, usual - 1, usual + 2};
  if (!whole) orders.pop_back();
  if (request.order) orders = {usual};
  for (bool single : {true, false}) {
    if (single && !single_serves(request, search.tree, shape.block)) continue;
    shape.single = single;
    search.try_orders(shape, orders, widest_opening);
  }
  if (request.leaf || search.best.direct || !whole) return;
  const TreeShape found = search.best.shape;
  for (int leaf : {16, 64}) {
    shape = found;
    shape.leaf = leaf;
    search.try_orders(shape, {&found.order, 1}, std::min(widest_opening, found.opening * 1.3));
  }
}

}  // namespace

TunedShape tuned_shape(const PointCharges<3>& points, int all, const CoulombRequest& request, TreeField& tree,
                       Threads threads) {
  const bool automatic = request.method == CoulombMethod::automatic;
  const int ranks = tree.ranks().subdomains.size();
  if (automatic && all < direct_below(request.accuracy, tree.isa()))
    return direct_because("fewer points than the crossover of the table");
  if (tree.in_subdomains() && all < least_points_of_a_rank * ranks)
    return direct_because("too few points for every rank to have a leaf");

  TreeShape shape;
  shape.local = request.local_expansions || tree.in_subdomains();
  shape.order = request.order.value_or(usual_order(request.accuracy));
  shape.opening = request.opening.value_or(0.4);
  shape.even = shape.local && !request.opening;
  shape.leaf = request.leaf.value_or(32);
  Search search{points, request, tree, threads};
  search_all(search, cheapest_order(points, all, request, shape, tree, threads));

  TunedShape& choice = search.best;
  if (choice.direct) {
    choice.reason = "no tree is as accurate as asked for";
  } else if (automatic && choice.work > 0.9 * static_cast<double>(all) * all / ranks) {
    choice.direct = true;
    choice.error = {};
    choice.reason = "no tree of this accuracy would be faster";
  } else {
    choice.reason = choice.error.bound <= request.accuracy ? "cheapest accurate shape"
                                                           : "pinned: less accurate than asked for";
  }
  return choice;
}

}  // namespace treejet
