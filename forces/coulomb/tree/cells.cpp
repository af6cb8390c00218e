#include "forces/coulomb/tree/cells.hpp"

#include <algorithm>
#include <cmath>

namespace treejet {

/// A cell without extent or charge is as good as it can be.
constexpr double widest_spread = 1000;

Cells::Cells(int points, int leaf) : points_(points), leaf_(leaf) {
  std::vector<int> counts = {(points + leaf - 1) / leaf};
  while (counts.back() > 1) counts.push_back((counts.back() + 1) / 2);
  first_ = {0};
  for (auto count = counts.rbegin(); count != counts.rend(); ++count)
    first_.push_back(first_.back() + *count);
  for (auto* values : {&centre_[0], &centre_[1], &centre_[2], &radius_, &critical_, &spread_, &weight_})
    values->resize(index(size()));
  for (int l = 0; l + 1 < levels(); ++l) {
    const CellRange next = level(l + 1);
    for (int child = next.first; child < next.last; child += 2)
      opened_.push_back({child, std::min(child + 2, next.last)});
  }
  for (int cell = level(levels() - 1).first; cell < size(); ++cell) opened_.push_back({cell, cell + 1});
  if (points > 0) roots_ = {0};
}

Rows Cells::leaf_points(int k) const {
  return {k * leaf_, std::min(points_, (k + 1) * leaf_)};
}

Rows Cells::points_of(int cell) const {
  if (cell >= size()) return grafted_points_[index(cell - size())];
  return leaf_points(cell - first_[index(levels() - 1)]);
}

void Cells::reserve(std::size_t cells) {
  for (auto* values : {&centre_[0], &centre_[1], &centre_[2], &radius_, &critical_}) values->reserve(cells);
  opened_.reserve(cells);
  grafted_points_.reserve(cells - index(size()));
}

void Cells::resize(std::size_t cells) {
  for (auto* values : {&centre_[0], &centre_[1], &centre_[2], &radius_, &critical_}) values->resize(cells);
  opened_.resize(cells);
  grafted_points_.resize(cells - index(size()));
}

int Cells::add(int count) {
  const int first = all();
  resize(index(first + count));
  return first;
}

int Cells::add_root() {
  return roots_.emplace_back(add(1));
}

void Cells::set(int cell, const Grafted& grafted) {
  const std::size_t k = index(cell);
  for (int e = 0; e < 3; ++e) centre_[e][k] = grafted.centre[e];
  radius_[k] = grafted.radius;
  critical_[k] = grafted.critical_radius;
  const bool closed = grafted.children.first == grafted.children.last;
  opened_[k] = closed ? CellRange{cell, cell + 1} : grafted.children;
  grafted_points_[k - index(size())] = grafted.points;
}

void Cells::prune() {
  resize(index(size()));
  roots_.resize(points_ > 0 ? 1 : 0);
}

std::int64_t Cells::bytes() const {
  const std::size_t numbers = 5 * radius_.capacity() + spread_.capacity() + weight_.capacity();
  return static_cast<std::int64_t>(numbers * sizeof(double) + opened_.capacity() * sizeof(CellRange) +
                                   grafted_points_.capacity() * sizeof(Rows));
}

CellRange Cells::below(int above, int k, int l) const {
  const CellRange all = level(l);
  const int down = l - above;
  return {all.first + (k << down), std::min(all.last, all.first + ((k + 1) << down))};
}

void Cells::enclose(const CellPoints& points, Reach reach, Threads threads) {
  const int cut = level_of_subtrees();
  for_each_task(threads, level(cut).last - level(cut).first, [&](int k) {
    for (int l = levels() - 1; l >= cut; --l) enclose(points, reach, l, below(cut, k, l));
  });
  for (int l = cut - 1; l >= 0; --l) enclose(points, reach, l, level(l));
  critical_ = radius_;
}

void Cells::enclose(const CellPoints& points, Reach reach, int l, CellRange cells) {
  for (int cell = cells.first; cell < cells.last; ++cell) {
    const int k = cell - level(l).first;
    if (l == levels() - 1)
      weigh(points, k);
    else
      weigh_children(l, k);
    measure(points, reach, l, k);
    const std::size_t id = index(cell);
    const double r = radius_[id], Q = weight_[id];
    spread_[id] = r > 0 && Q > 0 ? std::log2(4 * r * r / Q) : widest_spread;
  }
}

Cells::Spread Cells::spread() const {
  Spread all;
  for (int k = 0; k < leaves(); ++k) {
    const double spread = spread_[index(size() - leaves() + k)];
    const int points = leaf_points(k).size();
    // of a single point the radius is what rounding has left of 0
    if (points > 1 && spread < widest_spread) all.sum += points * spread, all.points += points;
  }
  return all;
}

void Cells::equalise_errors(int order, double opening, const Spread& among, Threads threads) {
  const double mean = among.points > 0 ? among.sum / among.points : 0;
  for_each_block(threads, {0, size()}, 512, [&](Rows cells) {
    for (int k = cells.first; k < cells.last; ++k) {
      const double inverse_u = std::exp2((mean - spread_[index(k)]) / (order + 2));
      critical_[index(k)] = radius_[index(k)] * std::max(inverse_u, opening / clearance);
    }
  });
}

void Cells::weigh(const CellPoints& all, int leaf) {
  const Rows points = leaf_points(leaf);
  double sum[3] = {}, mean[3] = {}, weight = 0;
  for (int i = points.first; i < points.last; ++i) {
    weight += std::abs(all.q[i]);
    for (int e = 0; e < 3; ++e) {
      sum[e] += std::abs(all.q[i]) * all.r[e][i];
      mean[e] += all.r[e][i];
    }
  }
  const std::size_t cell = index(level(levels() - 1).first + leaf);
  weight_[cell] = weight;
  for (int e = 0; e < 3; ++e) centre_[e][cell] = weight > 0 ? sum[e] / weight : mean[e] / points.size();
}

void Cells::weigh_children(int l, int cell) {
  const CellRange below = level(l + 1);
  const std::size_t parent = index(level(l).first + cell), left = index(below.first + 2 * cell);
  const std::size_t right = std::min(left + 1, index(below.last - 1));
  const double a = weight_[left], b = right > left ? weight_[right] : 0.0;
  weight_[parent] = a + b;
  const double share = a + b > 0 ? b / (a + b) : right > left ? 0.5 : 0.0;
  for (auto& centre : centre_) centre[parent] = centre[left] + share * (centre[right] - centre[left]);
}

/// Exact for cells of up to 8 leaves; above, from the balls of the children, which costs no pass over the
/// points and little tightness.
void Cells::measure(const CellPoints& points, Reach reach, int l, int cell) {
  const std::size_t id = index(level(l).first + cell);
  const double x = centre_[0][id], y = centre_[1][id], z = centre_[2][id];
  const int below = levels() - 1 - l;
  if (below > 3) {
    const CellRange next = level(l + 1);
    double radius = 0;
    for (int child = next.first + 2 * cell; child < std::min(next.last, next.first + 2 * cell + 2); ++child) {
      const std::size_t c = index(child);
      radius =
          std::max(radius, std::hypot(centre_[0][c] - x, centre_[1][c] - y, centre_[2][c] - z) + radius_[c]);
    }
    radius_[id] = radius;
    return;
  }
  CellPoints own = points;
  own.first = (cell << below) * leaf_;
  own.count = std::min(points_, ((cell + 1) << below) * leaf_) - own.first;
  const double centre[3] = {x, y, z};
  radius_[id] = reach(own, centre);
}

}  // namespace treejet
