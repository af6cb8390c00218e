#include "forces/coulomb/tree/tree_field.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "forces/coulomb/tree/barnes_hut.hpp"
#include "forces/coulomb/tree/multipole.hpp"
#include "forces/coulomb/tree/passes.hpp"
#include "forces/coulomb/tree/space_order.hpp"
#include "forces/coulomb/tree/traversal.hpp"

namespace treejet {

namespace {

/// Leaves, with all their work, that a thread takes at once.
constexpr int leaves_a_task = 64;

}  // namespace

void TreeField::place(const PointCharges<3>& points, const TreeShape& shape, Threads threads,
                      bool keep_order) {
  const bool same_cells = cells_.points() == points.n && cells_.leaf() == shape.leaf;
  if (!same_cells) cells_ = Cells(points.n, shape.leaf);
  if (shape.block == 0)
    points_.reorder({});
  else if (!keep_order || !same_cells || shape.block != shape_.block)
    points_.reorder(space_order(points.r.data(), points.n, shape.leaf, shape.block, threads));
  shape_ = shape;
  points_.read(points, threads);
  cells_.enclose(points_.points({0, points.n}), kernels_->reach, threads);
  equalise_errors(threads);
}

void TreeField::visit(Archive& state) {
  int points = cells_.points(), leaf = cells_.leaf();
  state(points, leaf, shape_, points_);
  if (state.reading() && points > 0) cells_ = Cells(points, leaf);
}

void TreeField::reshape(int order, double opening, Threads threads) {
  const bool same_order = order == shape_.order;
  shape_.order = order;
  shape_.opening = opening;
  equalise_errors(threads);
  if (!same_order) expand(threads);
}

void TreeField::equalise_errors(Threads threads) {
  if (shape_.even) cells_.equalise_errors(shape_.order, shape_.opening, cells_.spread(), threads);
}

void TreeField::expand(Threads threads) {
  const int order = shape_.order;
  expansions_ = {order, padded(Series::terms(order - 1)), padded(Series::terms(order)), {}, {}, {}, false};
  for (int e = 0; e < 3; ++e) expansions_.centre[e] = cells_.centre(e);
  history_.resize(index(cells_.size()) * index(expansions_.moment_stride));
  locals_.resize(index(cells_.size()) * index(expansions_.local_stride));
  expansions_.moments = history_.data();
  expansions_.locals = locals_.data();
  move_up(*kernels_, cells_, expansions_, points_.points({0, points_.size()}), threads);
}

CellPoints TreeField::leaf_cell(int leaf) const {
  return points_.points(cells_.leaf_points(leaf));
}

std::vector<int> TreeField::leaves_of(Rows rows) const {
  if (points_.in_callers_order() || rows.size() == cells_.points()) {
    std::vector<int> all(index((rows.last + shape_.leaf - 1) / shape_.leaf - rows.first / shape_.leaf));
    std::iota(all.begin(), all.end(), rows.first / shape_.leaf);
    return all;
  }
  std::vector<int> some;
  for (int leaf = 0; leaf < cells_.leaves(); ++leaf) {
    const Rows places = cells_.leaf_points(leaf);
    const auto asked = [&](int k) {
      return points_.source(k) >= rows.first && points_.source(k) < rows.last;
    };
    int k = places.first;
    while (k < places.last && !asked(k)) ++k;
    if (k < places.last) some.push_back(leaf);
  }
  return some;
}

std::vector<int> TreeField::points_of(int leaf) const {
  const Rows rows = cells_.leaf_points(leaf);
  std::vector<int> points(index(rows.size()));
  for (int k = rows.first; k < rows.last; ++k) points[index(k - rows.first)] = points_.source(k);
  return points;
}

Interactions TreeField::evaluate(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                                 Threads threads, double* potential) {
  const std::span<const int> own = own_share(leaves);
  expansions_.potential = potential != nullptr;
  points_.keep_potential(expansions_.potential);
  const Interactions done = shape_.local ? local_expansions(own, threads) : barnes_hut(own, threads);
  gather(leaves, expansions_.potential ? 4 : 3);
  for_each_block(threads, {0, static_cast<int>(leaves.size())}, leaves_a_task, [&](Rows some) {
    for (int n = some.first; n < some.last; ++n)
      points_.give(cells_.leaf_points(leaves[index(n)]), rows, field, potential);
  });
  return done;
}

Interactions TreeField::barnes_hut(std::span<const int> leaves, Threads threads) {
  const BarnesHut treecode(cells_, expansions_, points_.points({0, points_.size()}), shape_.opening);
  std::vector<Interactions> done(leaves.size());
  for_each_task(threads, static_cast<int>(leaves.size()),
                [&](int n) { done[index(n)] = treecode.act_on(leaves[index(n)], points_.sums().data()); });
  return total(done);
}

void TreeField::evaluate_directly(const std::vector<int>& leaves, const FieldArrays<3>& field,
                                  Threads threads) {
  const std::span<const int> own = own_share(leaves);
  const CellRange all = {0, cells_.points()};
  for_each_task(threads, static_cast<int>(own.size()),
                [&](int n) { kernels_->p2p(leaf_cell(own[index(n)]), &all, 1, points_.sums().data()); });
  gather(leaves, 3);
  for (int leaf : leaves) points_.give(cells_.leaf_points(leaf), {all.first, all.last}, field, nullptr);
}

std::span<const int> TreeField::own_share(const std::vector<int>& leaves) const {
  const std::vector<int> borders = ranks_.borders({0, static_cast<int>(leaves.size())}, 1);
  const std::size_t first = index(borders[index(ranks_.rank())]),
                    last = index(borders[index(ranks_.rank() + 1)]);
  return std::span(leaves).subspan(first, last - first);
}

/// The sums at the points of the leaves, packed leaf after leaf, go from each rank to all.
void TreeField::gather(const std::vector<int>& leaves, std::size_t sums) {
  if (ranks_.size() == 1) return;
  std::vector<int> packed = {0};  // place of each leaf
  for (int leaf : leaves) packed.push_back(packed.back() + cells_.leaf_points(leaf).size());
  std::vector<int> borders = ranks_.borders({0, static_cast<int>(leaves.size())}, 1);
  for (int& b : borders) b = packed[index(b)];
  std::array<std::vector<double>, 4> values;
  std::array<double*, 4> columns{};
  for (std::size_t e = 0; e < sums; ++e) {
    values[e].resize(index(packed.back()));
    columns[e] = values[e].data();
  }
  const std::array<double*, 4> own = points_.sums();
  const auto for_each_leaf = [&](auto&& copy) {
    for (std::size_t k = 0; k < leaves.size(); ++k)
      for (std::size_t e = 0; e < sums; ++e)
        copy(own[e] + cells_.leaf_points(leaves[k]).first, columns[e] + packed[k], packed[k + 1] - packed[k]);
  };
  for_each_leaf([](const double* sum, double* value, int n) { std::copy_n(sum, n, value); });
  ranks_.gather(std::span(columns).first(sums), borders);
  for_each_leaf([](double* sum, const double* value, int n) { std::copy_n(value, n, sum); });
}

void TreeField::act_near(int leaf, std::span<const int> near) {
  const std::vector<CellRange> sources = near_ranges(near, [&](int k) { return cells_.leaf_points(k); });
  const CellPoints target = leaf_cell(leaf);
  const int count = static_cast<int>(sources.size());
  if (expansions_.potential)
    return kernels_->p2p_with_potential(target, sources.data(), count, points_.sums().data());
  if (!shape_.single) return kernels_->p2p(target, sources.data(), count, points_.sums().data());
  const int cell = cells_.level(cells_.levels() - 1).first + leaf;
  NearUnits unit = {{}, cells_.radius()[cell], points_.charge_unit()};
  for (int e = 0; e < 3; ++e) unit.centre[e] = cells_.centre(e)[cell];
  if (!(unit.length > 0)) unit.length = 1;
  kernels_->p2p_single(target, sources.data(), count, unit, points_.sums().data());
}

Interactions TreeField::local_expansions(std::span<const int> leaves, Threads threads) {
  mark_above(cells_, leaves, wanted_);
  struct Task {
    int level, cell;
    std::vector<int> sources;  ///< far cells of one target cell above the cut, or candidates of a subtree
    bool subtree;
  };
  const int cut = level_of_subtrees(cells_);
  const auto walked = [this](int cell) { return wanted(cell); };

  std::vector<Task> tasks;
  const int root[] = {0};
  Traversal(cells_, shape_.opening)
      .walk(
          0, 0, root, cut, walked,
          [&](int cell, std::span<const int> far) {
            tasks.push_back({0, cell, {far.begin(), far.end()}, false});
          },
          [](int, std::span<const int>) {},
          [&](int level, int cell, std::span<const int> candidates) {
            tasks.push_back({level, cell, {candidates.begin(), candidates.end()}, true});
          });

  std::vector<Interactions> done(tasks.size());
  for_each_task(threads, static_cast<int>(tasks.size()), [&](int t) {
    const Task& task = tasks[index(t)];
    Interactions& count = done[index(t)];
    const auto far = [&](int cell, std::span<const int> sources) {
      kernels_->m2l(expansions_, cell, sources.data(), static_cast<int>(sources.size()));
      count.expansions += static_cast<int>(sources.size());
    };
    const auto near = [&](int leaf, std::span<const int> leaves) {
      act_near(leaf, leaves);
      for (int k : leaves)
        count.pairs += std::int64_t{cells_.leaf_points(leaf).size()} * cells_.leaf_points(k).size();
    };
    if (task.subtree)
      Traversal(cells_, shape_.opening)
          .walk(task.level, task.cell, task.sources, -1, walked, far, near,
                [](int, int, std::span<const int>) {});
    else
      far(task.cell, task.sources);
  });
  move_down(*kernels_, cells_, expansions_, wanted_, threads);
  const int bottom = cells_.level(cells_.levels() - 1).first;
  for_each_block(threads, {0, static_cast<int>(leaves.size())}, leaves_a_task, [&](Rows some) {
    for (int n = some.first; n < some.last; ++n)
      kernels_->l2p(expansions_, bottom + leaves[index(n)], leaf_cell(leaves[index(n)]),
                    points_.sums().data());
  });
  return total(done);
}

Interactions TreeField::count() const {
  const int root[] = {0};
  Interactions work;
  Traversal(cells_, shape_.opening)
      .walk(
          0, 0, root, -1, [](int) { return true; },
          [&](int, std::span<const int> far) {
            work.expansions += static_cast<int>((far.size() + 7) / 8 * 8);
          },
          [&](int leaf, std::span<const int> near) {
            for (int k : near)
              work.pairs += std::int64_t{cells_.leaf_points(leaf).size()} * cells_.leaf_points(k).size();
          },
          [](int, int, std::span<const int>) {});
  return work;
}

}  // namespace treejet
