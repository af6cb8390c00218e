#include "forces/coulomb/solver/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace treejet {

namespace {

constexpr double margin = 1.25;

/// The mean of E^2 over the points, the largest hundredth taken as nothing (SampledError).
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

/// `count` of all leaves, spread over the tree.
std::vector<int> sample_leaves(int all, int count) {
  std::vector<int> sample;
  for (int k = 0; k < count; ++k) {
    const double jitter = 0.618033988749895 * k;  // golden ratio: no stride of the jet can be in step with it
    const int leaf = static_cast<int>((k + jitter - static_cast<int>(jitter)) * all / count);
    if (sample.empty() || sample.back() != leaf) sample.push_back(leaf);
  }
  return sample;
}

/// How many points err by how much of their own field, in classes of a quarter of an octave: counts of
/// several ranks can be added.
class OwnErrors {
 public:
  /// Of a point, squared; what is not finite is passed over.
  void add(double error, double field) {
    const double place = classes_an_octave * std::log2(error / field) / 2 + one;
    if (std::isfinite(error) && field > 0)
      ++counts_[index(static_cast<int>(std::clamp(place, 0.0, double(counts_.size() - 1))))];
  }

  /// The upper edge of the class that 99 in 100 points do not go beyond.
  double of_99_in_100(const Ranks& ranks) const {
    std::array<double, size> counts = counts_;
    ranks.sum(counts);
    double above = 0.01 * std::accumulate(counts.begin(), counts.end(), 0.0);
    if (above == 0) return 0;
    int k = size - 1;
    while ((above -= counts[index(k)]) >= 0) --k;
    return std::exp2(double(k + 1 - one) / classes_an_octave);
  }

 private:
  static constexpr int classes_an_octave = 4, size = 256, one = 240;  // the class that begins at 1
  std::array<double, size> counts_ = {};
};

/// The squared errors of sampled leaves, added up.
struct LeafErrors {
  double leaves = 0, sum = 0, sum_squares = 0, largest = 0;

  /// Those at the points of one leaf; what is not finite (coincident points) is passed over.
  void add(std::span<const double> squares) {
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

  LeafErrors of_all(const Ranks& ranks) const {
    double sums[] = {leaves, sum, sum_squares};
    ranks.sum(sums);
    return {sums[0], sums[1], sums[2], ranks.greatest(largest)};
  }

  /// The bound is the mean over the sampled leaves plus two standard deviations of that mean, times a margin.
  SampledError relative_to(double mean_square, double own) const {
    if (mean_square == 0 || leaves == 0) return {};
    const double mean = sum / leaves;
    const double spread = std::sqrt(std::max(0.0, sum_squares / leaves - mean * mean) / leaves);
    return {std::sqrt(mean / mean_square), std::sqrt(largest / mean_square),
            margin * std::sqrt((mean + 2 * spread) / mean_square), own};
  }
};

std::vector<int> all_leaves(const TreeField& tree) {
  std::vector<int> all(index(tree.leaves()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

CoulombSample::CoulombSample(TreeField& tree, Threads threads) {
  const Ranks& ranks = tree.ranks().subdomains;
  double points = tree.points();
  ranks.sum({&points, 1});

  // The size of the whole field, from the tree itself: it need not be exact.
  tree.sum(all_leaves(tree), threads);
  if (points > 0) mean_square_ = tree.points() / points * typical_square(tree.sums());
  ranks.sum({&mean_square_, 1});

  const Spread all = spread(tree, sampled_points(static_cast<int>(points), tree.in_subdomains()));
  const auto me = index(ranks.rank());
  first_ = all.borders[me];
  leaves_.assign(all.leaves.begin() + first_, all.leaves.begin() + all.borders[me + 1]);
  sum_directly(tree, all, threads);
}

CoulombSample::Spread CoulombSample::spread(const TreeField& tree, int points) {
  const Ranks& ranks = tree.ranks().subdomains;
  const double own[] = {double(tree.leaves())};
  std::vector<int> first = {0};
  for (double count : ranks.of_all(own)) first.push_back(first.back() + static_cast<int>(count));

  Spread all;
  all.leaves = sample_leaves(first.back(), std::min(first.back(), points / tree.shape().leaf));
  for (int border : first)
    all.borders.push_back(static_cast<int>(std::lower_bound(all.leaves.begin(), all.leaves.end(), border) -
                                           all.leaves.begin()));
  for (int rank = 0; rank < ranks.size(); ++rank)
    for (int k = all.borders[index(rank)]; k < all.borders[index(rank) + 1]; ++k)
      all.leaves[index(k)] -= first[index(rank)];
  return all;
}

/// The sampled points of all subdomains stand before the own points, so that the sums need room for the
/// former only. An own sampled leaf acts on itself by its copy, whose pairs of a point with itself the kernel
/// knows.
void CoulombSample::sum_directly(const TreeField& tree, const Spread& all, Threads threads) {
  const Ranks &subdomains = tree.ranks().subdomains, &sharing = tree.ranks().sharing;
  const Cells& cells = tree.tree().cells;
  const int leaf = tree.shape().leaf, sampled_leaves = static_cast<int>(all.leaves.size()),
            sampled = leaf * sampled_leaves, n = tree.points();
  std::array<std::vector<double>, 4> r_and_q;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto own = tree.tree().points.columns()[c]->begin();
    auto& values = r_and_q[c];
    values.resize(index(sampled));
    for (std::size_t k = 0; k < leaves_.size(); ++k) {
      const Rows points = cells.leaf_points(leaves_[k]);
      std::copy(own + points.first, own + points.last,
                values.begin() + (first_ + static_cast<int>(k)) * leaf);
    }
    values.insert(values.end(), own, own + n);
  }
  std::vector<int> borders = all.borders;
  for (int& border : borders) border *= leaf;
  auto& [x, y, z, q] = r_and_q;
  subdomains.gather(std::array{x.data(), y.data(), z.data()}, borders);

  std::vector<double> sums(3 * index(sampled));
  const FieldArrays<3> E = {sums.data(), sums.data() + sampled, sums.data() + 2 * sampled};
  borders = sharing.borders({0, sampled_leaves}, 1);
  const int begin = borders[index(sharing.rank())], end = borders[index(sharing.rank() + 1)];
  const CellPoints points = {{x.data(), y.data(), z.data()}, q.data(), 0, 0};
  for_each_task(threads, end - begin, [&](int task) {
    const int s = begin + task, k = s - first_;
    const bool own = k >= 0 && k < static_cast<int>(leaves_.size());
    const Rows same = own ? cells.leaf_points(leaves_[index(k)]) : Rows{};
    CellPoints target = points;
    target.first = s * leaf;
    target.count = own ? same.size() : leaf;
    const CellRange sources[] = {{sampled, sampled + same.first},
                                 {target.first, target.first + same.size()},
                                 {sampled + same.last, sampled + n}};
    wide_kernels(tree.isa()).p2p(target, sources, 3, E.data());
  });
  for (int& border : borders) border *= leaf;
  sharing.gather(E, borders);
  subdomains.sum(sums);
  for (std::size_t e = 0; e < 3; ++e)
    direct_[e].assign(E[e] + first_ * leaf, E[e] + (first_ + static_cast<int>(leaves_.size())) * leaf);
}

SampledError CoulombSample::error(TreeField& tree, Threads threads) const {
  tree.sum(leaves_, threads);
  const auto E = tree.sums();
  const auto leaf = index(tree.shape().leaf);
  LeafErrors errors;
  OwnErrors own;
  std::vector<double> squares;
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const Rows points = tree.tree().cells.leaf_points(leaves_[k]);
    squares.assign(index(points.size()), 0.0);
    for (std::size_t i = 0; i < squares.size(); ++i) {
      double field = 0;
      for (std::size_t e = 0; e < 3; ++e) {
        const double exact = direct_[e][k * leaf + i];
        squares[i] += std::pow(E[e][index(points.first) + i] - exact, 2);
        field += exact * exact;
      }
      own.add(squares[i], field);
    }
    errors.add(squares);
  }
  const Ranks& ranks = tree.ranks().subdomains;
  return errors.of_all(ranks).relative_to(mean_square_, own.of_99_in_100(ranks));
}

}  // namespace treejet
