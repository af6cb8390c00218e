#include "forces/coulomb/solver/autotune.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/tree_parameters.hpp"
namespace treejet {

namespace {

constexpr double margin = 1.25;
/// Below this accuracy a near field in single precision is not tried.
constexpr double finest_single = 3e-5;

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

double typical_square(const std::array<std::span<const double>, 3>& E) {
  std::vector<double> squares;
  for (std::size_t i = 0; i < E[0].size(); ++i) {
    const double square = E[0][i] * E[0][i] + E[1][i] * E[1][i] + E[2][i] * E[2][i];
    if (std::isfinite(square)) squares.push_back(square);
  }
  if (squares.empty()) return 0;
  const auto typical = squares.end() - static_cast<std::ptrdiff_t>(squares.size() / 100);
  std::nth_element(squares.begin(), typical, squares.end());
  return std::accumulate(squares.begin(), typical, 0.0) / static_cast<double>(squares.size());
}

std::vector<int> sample_leaves(int all, int count) {
  std::vector<int> sample;
  for (int k = 0; k < count; ++k) {
    const double jitter = 0.618033988749895 * k;  // golden ratio: no stride of the jet can be in step with it
    const int leaf = static_cast<int>((k + jitter - static_cast<int>(jitter)) * all / count);
    if (sample.empty() || sample.back() != leaf) sample.push_back(leaf);
  }
  return sample;
}

void LeafErrors::add(std::span<const double> squares) {
  double square = 0;
  for (double s : squares) {
    if (!std::isfinite(s)) continue;
    square += s / static_cast<double>(squares.size());
    largest = std::max(largest, s);
  }
  sum += square;
  sum_squares += square * square;
  ++leaves;
}

SampledError LeafErrors::relative_to(double mean_square) const {
  if (mean_square == 0 || leaves == 0) return {};
  const double mean = sum / leaves;
  const double spread = std::sqrt(std::max(0.0, sum_squares / leaves - mean * mean) / leaves);
  return {std::sqrt(mean / mean_square), std::sqrt(largest / mean_square),
          margin * std::sqrt((mean + 2 * spread) / mean_square)};
}

CoulombSample::CoulombSample(int points, TreeField& tree, Threads threads)
    : n_(points), leaves_(sample_leaves(tree.leaves(), sampled_points(points) / tree.shape().leaf)) {
  for (auto& values : direct_) values.assign(static_cast<std::size_t>(n_), 0.0);
  for (auto& values : tried_) values.assign(static_cast<std::size_t>(n_), 0.0);
  const FieldArrays<3> field = {direct_[0].data(), direct_[1].data(), direct_[2].data()};

  // The size of the whole field, from the tree itself: it need not be exact.
  tree.evaluate(tree.leaves_of({0, n_}), {0, n_}, field, threads);
  mean_square_ = typical_square({direct_[0], direct_[1], direct_[2]});
  for (int leaf : leaves_) points_of_leaf_.push_back(tree.points_of(leaf));
  tree.evaluate_directly(leaves_, field, threads);
}

SampledError CoulombSample::error(TreeField& tree, Threads threads) {
  tree.evaluate(leaves_, {0, n_}, {tried_[0].data(), tried_[1].data(), tried_[2].data()}, threads);
  LeafErrors errors;
  std::vector<double> squares;
  for (const auto& points : points_of_leaf_) {
    squares.clear();
    for (int k : points) {
      const auto i = static_cast<std::size_t>(k);
      double difference2 = 0;
      for (std::size_t e = 0; e < 3; ++e) difference2 += std::pow(tried_[e][i] - direct_[e][i], 2);
      squares.push_back(difference2);
    }
    errors.add(squares);
  }
  return errors.relative_to(mean_square_);
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

/// Chain or space: the order of points with the least work at this shape, with one opening for all cells:
/// evened out it goes by the mean leaf, which is another in each order.
TreeShape cheapest_order(const PointCharges<3>& points, const CoulombRequest& request, TreeShape shape,
                         Isa isa, TreeField& tree, Threads threads) {
  TreeShape tried = shape;
  tried.even = false;
  double least = std::numeric_limits<double>::infinity();
  for (int block : {0, 16, 4, 1}) {
    if (request.space && *request.space != (block > 0)) continue;
    tried.block = block;
    tree.place(points, tried, threads);
    const double work = cost(tree.count(), tried, points.n, isa);
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
  Isa isa;
  TreeField& tree;
  Threads threads;
  TunedShape best{};

  /// The widest opening that is accurate enough at each of these orders, from a bit wider than `widest` down.
  void try_orders(const TreeShape& shape, std::initializer_list<int> orders, double widest) {
    tree.arrange(points, shape, threads);
    CoulombSample sample(points.n, tree, threads);
    for (int order : orders)
      if (tree_parameters::is_order(order)) try_openings(order, sample, widest);
  }

  void try_openings(int order, CoulombSample& sample, double widest) {
    for (double opening = request.opening.value_or(widest); opening > narrowest_opening;
         opening *= opening_step) {
      tree.reshape(order, opening, threads);
      const SampledError error = sample.error(tree, threads);
      const bool pinned = request.opening.has_value();
      if (error.bound <= request.accuracy || (pinned && request.order)) {
        const Interactions counted = tree.count();
        if (counted.expansions == 0 && !pinned) return;  // all pairs are near: a direct sum in disguise
        const double work = cost(counted, tree.shape(), points.n, isa);
        if (work < best.work) best = {false, {}, tree.shape(), error, work};
        return;
      }
      if (pinned) return;
    }
  }
};

}  // namespace

TunedShape tuned_shape(const PointCharges<3>& points, const CoulombRequest& request, Isa isa, TreeField& tree,
                       Threads threads) {
  const bool automatic = request.method == CoulombMethod::automatic;
  if (automatic && points.n < direct_below(request.accuracy, isa))
    return direct_because("fewer points than the crossover of the table");

  TreeShape shape;
  shape.local = request.local_expansions;
  shape.order = request.order.value_or(usual_order(request.accuracy));
  shape.opening = request.opening.value_or(0.4);
  shape.even = shape.local && !request.opening;
  shape.leaf = request.leaf.value_or(32);
  shape = cheapest_order(points, request, shape, isa, tree, threads);

  Search search{points, request, isa, tree, threads};
  const int usual = shape.order;
  for (bool single : {true, false}) {
    // points that move may come to share a leaf with some far off, on whose scale they are one in single
    // precision; on a chain they do not
    if (single && (request.accuracy < finest_single || (request.points_move && shape.block > 0))) continue;
    shape.single = single;
    if (request.order)
      search.try_orders(shape, {usual}, widest_opening);
    else
      search.try_orders(shape, {usual, usual + 1, usual - 1, usual + 2}, widest_opening);
  }
  if (!request.leaf && !search.best.direct) {
    const TreeShape found = search.best.shape;
    for (int leaf : {16, 64}) {
      shape = found;
      shape.leaf = leaf;
      search.try_orders(shape, {found.order}, std::min(widest_opening, found.opening * 1.3));
    }
  }

  TunedShape& choice = search.best;
  if (choice.direct) {
    choice.reason = "no tree is as accurate as asked for";
  } else if (automatic && search.best.work > 0.9 * static_cast<double>(points.n) * points.n) {
    choice.direct = true;
    choice.error = {};
    choice.reason = "no tree of this accuracy would be faster";
  } else {
    choice.reason = choice.error.bound <= request.accuracy ? "cheapest accurate shape"
                                                           : "pinned: less accurate than asked for";
    tree.arrange(points, choice.shape, threads);
  }
  return choice;
}

}  // namespace treejet
