#include "forces/coulomb/tree/tree_field.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/tree_parameters.hpp"
#include "forces/coulomb/tree/barnes_hut.hpp"
#include "forces/coulomb/tree/space_order.hpp"
#include "forces/coulomb/tree/traversal.hpp"
#include "parallel/work_clock.hpp"

namespace treejet {

namespace {

/// Leaves, with all their work, that a thread takes at once.
constexpr int leaves_a_task = 64;

std::int64_t pairs(const Cells& cells, int leaf, std::span<const int> near) {
  std::int64_t sources = 0;
  for (int k : near) sources += cells.points_of(k).size();
  return cells.leaf_points(leaf).size() * sources;
}

}  // namespace

/// Far cells of one target cell above the cut, or candidates of a subtree.
struct TreeField::Task {
  int level, cell;
  std::vector<int> sources;
  bool subtree;
};

void TreeField::place(const PointCharges<3>& points, const TreeShape& shape, Threads threads,
                      bool keep_order) {
  const Working at(Work::build);
  Cells& cells = tree_.cells;
  const bool same_cells = cells.points() == points.n && cells.leaf() == shape.leaf;
  if (same_cells)
    cells.prune();
  else
    cells = Cells(points.n, shape.leaf);
  if (shape.block == 0)
    tree_.points.reorder({});
  else if (!keep_order || !same_cells || shape.block != shape_.block)
    tree_.points.reorder(space_order(points.r.data(), points.n, shape.leaf, shape.block, threads));
  shape_ = shape;
  tree_.points.read(points, threads);
  cells.enclose(tree_.all_points(), kernels_->reach, threads);
  equalise_errors(threads);
}

void TreeShape::visit(Archive& state) {
  int flags = single | local << 1 | even << 2;  // bools of other values would be undefined
  state(order, opening, leaf, block, flags);
  single = flags & 1, local = flags & 2, even = flags & 4;
  const bool known_block = block == 0 || block == 1 || block == 4 || block == 16;
  // an opening is tried one step wider than it is
  if (!tree_parameters::is_order(order) || !(opening >= 0 && opening < 1) ||
      !tree_parameters::is_leaf(leaf) || !known_block)
    throw FileError("the checkpoint's tree has a shape that no tree has");
}

void TreeField::visit(Archive& state) {
  state(shape_, tree_.points);
  // without an order of its own there is nothing to keep
  if (state.reading() && !tree_.points.in_callers_order())
    tree_.cells = Cells(tree_.points.ordered(), shape_.leaf);
}

void TreeField::reshape(const TreeShape& shape, Threads threads) {
  const bool same_order = shape.order == shape_.order;
  if (same_order && shape.opening == shape_.opening) {
    shape_.single = shape.single;
    return;
  }
  shape_ = shape;
  equalise_errors(threads);
  if (same_order)
    others_.graft(tree_, shape_, *kernels_);
  else
    expand(threads);
}

void TreeField::equalise_errors(Threads threads) {
  if (!shape_.even) return;
  const Cells::Spread own = tree_.cells.spread();
  double all[] = {own.sum, own.points};
  ranks_.subdomains.sum(all);
  tree_.cells.equalise_errors(shape_.order, shape_.opening, {all[0], all[1]}, threads);
}

void TreeField::expand(Threads threads) {
  tree_.order = shape_.order;
  tree_.moments.resize(index(tree_.cells.size()) * tree_.moment_stride());
  tree_.locals.resize(index(tree_.cells.size()) * tree_.local_stride());
  {
    const Working at(Work::upward);
    move_up(*kernels_, tree_.cells, tree_.expansions(), tree_.all_points(), threads);
  }
  const Working at(Work::exchange);
  others_.graft(tree_, shape_, *kernels_);
}

std::vector<int> TreeField::leaves_of(Rows rows) const {
  const OrderedPoints& points = tree_.points;
  if (points.in_callers_order() || rows.size() == points.size()) {
    std::vector<int> all(index((rows.last + shape_.leaf - 1) / shape_.leaf - rows.first / shape_.leaf));
    std::iota(all.begin(), all.end(), rows.first / shape_.leaf);
    return all;
  }
  std::vector<int> some;
  for (int leaf = 0; leaf < leaves(); ++leaf) {
    const Rows places = tree_.cells.leaf_points(leaf);
    const auto asked = [&](int k) { return points.source(k) >= rows.first && points.source(k) < rows.last; };
    int k = places.first;
    while (k < places.last && !asked(k)) ++k;
    if (k < places.last) some.push_back(leaf);
  }
  return some;
}

Interactions TreeField::evaluate(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                                 Threads threads, double* potential) {
  const Working at(Work::evaluate);
  const Interactions done = sum(leaves, threads, potential != nullptr);
  for_each_block(threads, {0, static_cast<int>(leaves.size())}, leaves_a_task, [&](Rows some) {
    for (int n = some.first; n < some.last; ++n)
      tree_.points.give(tree_.cells.leaf_points(leaves[index(n)]), rows, field, potential);
  });
  return done;
}

Interactions TreeField::sum(const std::vector<int>& leaves, Threads threads, bool potential) {
  const Working at(Work::evaluate);
  tree_.points.keep_potential(potential);
  const std::span<const int> own = own_share(leaves);
  Interactions done;
  if (!own.empty())
    done = shape_.local ? local_expansions(own, potential, threads) : barnes_hut(own, potential, threads);
  gather(leaves, potential ? 4 : 3);
  return done;
}

Interactions TreeField::barnes_hut(std::span<const int> leaves, bool potential, Threads threads) {
  const Expansions expansions = tree_.expansions(potential);
  const BarnesHut treecode(tree_.cells, expansions, tree_.all_points(), shape_.opening);
  std::vector<Interactions> done(leaves.size());
  for_each_task(threads, static_cast<int>(leaves.size()), [&](int n) {
    done[index(n)] = treecode.act_on(leaves[index(n)], tree_.points.sums().data());
  });
  return total(done);
}

std::span<const int> TreeField::own_share(const std::vector<int>& leaves) const {
  const std::vector<int> borders = ranks_.sharing.borders({0, static_cast<int>(leaves.size())}, 1);
  const std::size_t first = index(borders[index(ranks_.sharing.rank())]),
                    last = index(borders[index(ranks_.sharing.rank() + 1)]);
  return std::span(leaves).subspan(first, last - first);
}

/// The sums at the points of the leaves, packed leaf after leaf, go from each rank to all.
void TreeField::gather(const std::vector<int>& leaves, std::size_t sums) {
  if (ranks_.sharing.size() == 1) return;
  const Working at(Work::exchange);
  const Cells& cells = tree_.cells;
  std::vector<int> packed = {0};  // place of each leaf
  for (int leaf : leaves) packed.push_back(packed.back() + cells.leaf_points(leaf).size());
  std::vector<int> borders = ranks_.sharing.borders({0, static_cast<int>(leaves.size())}, 1);
  for (int& b : borders) b = packed[index(b)];
  std::array<std::vector<double>, 4> values;
  std::array<double*, 4> columns{};
  for (std::size_t e = 0; e < sums; ++e) {
    values[e].resize(index(packed.back()));
    columns[e] = values[e].data();
  }
  const std::array<double*, 4> own = tree_.points.sums();
  const auto for_each_leaf = [&](auto&& copy) {
    for (std::size_t k = 0; k < leaves.size(); ++k)
      for (std::size_t e = 0; e < sums; ++e)
        copy(own[e] + cells.leaf_points(leaves[k]).first, columns[e] + packed[k], packed[k + 1] - packed[k]);
  };
  for_each_leaf([](const double* sum, double* value, int n) { std::copy_n(sum, n, value); });
  ranks_.sharing.gather(std::span(columns).first(sums), borders);
  for_each_leaf([](double* sum, const double* value, int n) { std::copy_n(value, n, sum); });
}

void TreeField::act_near(int leaf, std::span<const int> near, bool potential) {
  const Cells& cells = tree_.cells;
  const std::vector<CellRange> sources = near_ranges(cells, near);
  const CellPoints target = tree_.leaf(leaf);
  const int count = static_cast<int>(sources.size());
  const std::array<double*, 4> sums = tree_.points.sums();
  if (potential) return kernels_->p2p_with_potential(target, sources.data(), count, sums.data());
  if (!shape_.single) return kernels_->p2p(target, sources.data(), count, sums.data());
  const int cell = cells.level(cells.levels() - 1).first + leaf;
  NearUnits unit = {{}, cells.radius()[cell], tree_.points.charge_unit()};
  for (int e = 0; e < 3; ++e) unit.centre[e] = cells.centre(e)[cell];
  if (!(unit.length > 0)) unit.length = 1;
  kernels_->p2p_single(target, sources.data(), count, unit, sums.data());
}

/// What is done above the cut, and the subtrees below it, for those to whom `wanted_` leads.
std::vector<TreeField::Task> TreeField::tasks(Threads threads) const {
  std::vector<Task> tasks;
  Traversal(tree_.cells, shape_.opening)
      .walk(
          0, 0, tree_.cells.roots(), level_of_walks(tree_.cells, threads),
          [this](int cell) { return wanted_[index(cell)]; },
          [&](int cell, std::span<const int> far) {
            tasks.push_back({0, cell, {far.begin(), far.end()}, false});
          },
          [](int, std::span<const int>) {},
          [&](int level, int cell, std::span<const int> candidates) {
            tasks.push_back({level, cell, {candidates.begin(), candidates.end()}, true});
          });
  return tasks;
}

Interactions TreeField::local_expansions(std::span<const int> leaves, bool potential, Threads threads) {
  const Cells& cells = tree_.cells;
  const Expansions expansions = tree_.expansions(potential);
  mark_above(cells, leaves, wanted_);
  const std::vector<Task> tasks = this->tasks(threads);
  std::vector<Interactions> done(tasks.size());
  for_each_task(threads, static_cast<int>(tasks.size()), [&](int t) {
    const Task& task = tasks[index(t)];
    Interactions& count = done[index(t)];
    const auto far = [&](int cell, std::span<const int> sources) {
      kernels_->m2l(expansions, cell, sources.data(), static_cast<int>(sources.size()));
      count.expansions += static_cast<int>(sources.size());
    };
    const auto near = [&](int leaf, std::span<const int> sources) {
      act_near(leaf, sources, potential);
      count.pairs += pairs(cells, leaf, sources);
    };
    if (task.subtree)
      Traversal(cells, shape_.opening)
          .walk(
              task.level, task.cell, task.sources, -1, [this](int cell) { return wanted_[index(cell)]; }, far,
              near, [](int, int, std::span<const int>) {});
    else
      far(task.cell, task.sources);
  });
  move_down(*kernels_, cells, expansions, wanted_, tree_.all_points(), tree_.points.sums().data(), threads);
  return total(done);
}

Interactions TreeField::count() const {
  Interactions work;
  if (points() == 0) return work;
  Traversal(tree_.cells, shape_.opening)
      .walk(
          0, 0, tree_.cells.roots(), -1, [](int) { return true; },
          [&](int, std::span<const int> far) {
            work.expansions += static_cast<int>((far.size() + 7) / 8 * 8);
          },
          [&](int leaf, std::span<const int> near) { work.pairs += pairs(tree_.cells, leaf, near); },
          [](int, int, std::span<const int>) {});
  return work;
}

std::int64_t TreeField::bytes() const {
  const std::size_t words = tree_.moments.capacity() + tree_.locals.capacity();
  return static_cast<std::int64_t>(words * sizeof(double) + wanted_.capacity()) + tree_.cells.bytes() +
         tree_.points.bytes() + others_.bytes();
}

}  // namespace treejet
