#include "forces/coulomb_calibration.hpp"

#include <algorithm>
#include <cmath>

namespace treejet {

namespace {

constexpr int sampled_leaves = 32;
constexpr double margin = 1.25;
constexpr double openings[] = {0.80, 0.70, 0.62, 0.55, 0.50, 0.45, 0.40, 0.35, 0.30,
                               0.26, 0.23, 0.20, 0.17, 0.15, 0.13, 0.11, 0.09};

/// The order that usually costs least; measured on jets and coils.
int usual_order(double accuracy) {
  return std::clamp(static_cast<int>(std::lround(-1.35 * std::log10(accuracy))), 3, 13);
}

CoulombChoice direct_because(const std::string& reason) {
  CoulombChoice choice;
  choice.reason = reason;
  return choice;
}

}  // namespace

CoulombSample::CoulombSample(int points, CoulombTree& tree, Threads threads)
    : n_(points), leaves_(tree.sample_leaves(sampled_leaves)) {
  for (auto& values : direct_) values.assign(static_cast<std::size_t>(n_), 0.0);
  for (auto& values : tried_) values.assign(static_cast<std::size_t>(n_), 0.0);
  const FieldArrays<3> field = {direct_[0].data(), direct_[1].data(), direct_[2].data()};

  // The size of the whole field, from the tree itself: it need not be exact.
  tree.evaluate(tree.leaves_of({0, n_}), {0, n_}, field, threads);
  for (std::size_t i = 0; i < direct_[0].size(); ++i) {
    const double square =
        direct_[0][i] * direct_[0][i] + direct_[1][i] * direct_[1][i] + direct_[2][i] * direct_[2][i];
    if (std::isfinite(square)) mean_square_ += square / n_;
  }
  for (int leaf : leaves_) points_of_leaf_.push_back(tree.points_of(leaf));
  tree.evaluate_directly(leaves_, field, threads);
}

double CoulombSample::error(CoulombTree& tree, Threads threads) {
  tree.evaluate(leaves_, {0, n_}, {tried_[0].data(), tried_[1].data(), tried_[2].data()}, threads);
  double sum = 0, sum_squares = 0, count = 0;
  for (const auto& points : points_of_leaf_) {
    double square = 0;
    for (int k : points) {
      const auto i = static_cast<std::size_t>(k);
      double difference2 = 0;
      for (std::size_t e = 0; e < 3; ++e) difference2 += std::pow(tried_[e][i] - direct_[e][i], 2);
      if (std::isfinite(difference2)) square += difference2 / static_cast<double>(points.size());
    }
    sum += square;
    sum_squares += square * square;
    ++count;
  }
  if (mean_square_ == 0) return 0;
  const double mean = sum / count;
  const double spread = std::sqrt(std::max(0.0, sum_squares / count - mean * mean) / count);
  return margin * std::sqrt((mean + 2 * spread) / mean_square_);
}

double price(const Interactions& work, const TreeShape& shape, int points, VectorPath path) {
  // an M2L of order 2, 3, ..., 14; measured, and so is the rest
  constexpr double wide[] = {20, 28, 39, 61, 88, 130, 181, 250, 336, 445, 575, 740, 948};
  constexpr double narrow[] = {14, 19, 29, 41, 73, 97, 125, 185, 256, 330, 416, 530, 672};
  const double expansion = (path == VectorPath::avx512 ? wide : narrow)[shape.order - 2];
  const double point =
      40 + 1.9 * shape.order * shape.order;  // P2M, L2P, copies; M2M and L2L for leaves of 32
  const double sort = shape.block == 0 ? 0 : 150.0 / shape.block + 10;
  return static_cast<double>(work.pairs) + expansion * static_cast<double>(work.expansions) +
         (point + sort) * points;
}

int direct_below(double accuracy, VectorPath path) {
  const double digits = std::clamp(-std::log10(accuracy), 2.0, 12.0);
  const double wide = 250 * digits * digits / 2;
  return static_cast<int>(path == VectorPath::avx512 ? wide : 0.7 * wide);
}

CoulombChoice coulomb_choice(const PointCharges<3>& points, const CoulombRequest& request, VectorPath path,
                             CoulombTree& tree, Threads threads) {
  const bool automatic = request.method == CoulombMethod::automatic;
  if (automatic && points.n < direct_below(request.accuracy, path))
    return direct_because("fewer points than the crossover of the table");

  TreeShape shape;
  shape.local = request.local_expansions;
  shape.order = request.order.value_or(usual_order(request.accuracy));
  shape.opening = request.opening.value_or(0.4);
  shape.leaf = request.leaf.value_or(32);
  double least = 0;
  TreeShape best = shape;
  for (int block : {0, 16, 4, 1}) {
    if (request.space && *request.space != (block > 0)) continue;
    shape.block = block;
    tree.arrange(points, {2, shape.opening, shape.leaf, block, shape.local}, threads);
    const double work = price(tree.count(), shape, points.n, path);
    if (least == 0 || work < least) best = shape, least = work;
  }
  shape = best;

  tree.arrange(points, shape, threads);
  CoulombSample sample(points.n, tree, threads);
  CoulombChoice choice;
  least = 0;
  const int usual = shape.order;
  for (int order : {usual, usual + 1, usual - 1, usual + 2}) {
    if (request.order ? order != usual : order < 2 || order > 14) continue;
    for (double opening : openings) {
      if (request.opening) opening = *request.opening;
      tree.reshape(order, opening, threads);
      const double error = sample.error(tree, threads);
      ++choice.measurements;
      if (error <= request.accuracy) {
        const double work = price(tree.count(), tree.shape(), points.n, path);
        if (least == 0 || work < least) {
          least = work;
          choice.shape = tree.shape();
          choice.expected_error = error;
        }
        break;
      }
      if (request.opening) break;
    }
  }
  if (least == 0 && request.order && request.opening) {
    choice.shape = tree.shape();
    choice.reason = "pinned, less accurate than asked for";
    choice.expected_error = sample.error(tree, threads);
  } else if (least == 0) {
    return direct_because("no tree is as accurate as asked for");
  } else if (automatic && least > 0.9 * static_cast<double>(points.n) * points.n) {
    return direct_because("no tree of this accuracy would be faster");
  }
  choice.direct = false;
  tree.reshape(choice.shape.order, choice.shape.opening, threads);
  return choice;
}

}  // namespace treejet
