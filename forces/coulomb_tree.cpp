#include "forces/coulomb_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "forces/multipole.hpp"
#include "forces/space_order.hpp"
#include "forces/traversal.hpp"

namespace treejet {

namespace {

std::size_t index(int k) {
  return static_cast<std::size_t>(k);
}

int padded(int terms) {
  return (terms + 7) / 8 * 8;
}

/// Cells a thread takes at once: leaves with all their work, and cells only moved up or down a level.
constexpr int leaves_a_task = 64, cells_a_task = 512;

}  // namespace

void CoulombTree::arrange(const PointCharges<3>& points, const TreeShape& shape, Threads threads,
                          bool keep_order) {
  const bool same_cells = cells_.points() == points.n && cells_.leaf() == shape.leaf;
  if (!same_cells) cells_ = Cells(points.n, shape.leaf);
  if (shape.block == 0)
    order_.clear();
  else if (!keep_order || !same_cells || shape.block != shape_.block)
    order_ = space_order(points.r.data(), points.n, shape.leaf, shape.block, threads);
  shape_ = shape;
  copy_points(points, threads);
  charge_unit_ = 0;
  for (double q : q_) charge_unit_ = std::max(charge_unit_, std::abs(q));
  if (!(charge_unit_ > 0)) charge_unit_ = 1;
  cells_.enclose({{r_[0].data(), r_[1].data(), r_[2].data()}, q_.data(), 0, points.n}, kernels_->reach,
                 threads);
  expand(shape.order, threads);
}

void CoulombTree::visit(Archive& state) {
  int points = cells_.points(), leaf = cells_.leaf();
  state(points, leaf, shape_, order_);
  if (state.reading() && points > 0) cells_ = Cells(points, leaf);
}

void CoulombTree::reshape(int order, double opening, Threads threads) {
  shape_.opening = opening;
  if (order != shape_.order) expand(order, threads);
  shape_.order = order;
}

void CoulombTree::expand(int order, Threads threads) {
  expansions_ = {order, padded(Series::terms(order - 1)), padded(Series::terms(order)), {}, {}, {}};
  for (int e = 0; e < 3; ++e) expansions_.centre[e] = cells_.centre(e);
  moments_.resize(index(cells_.size()) * index(expansions_.moment_stride));
  locals_.resize(index(cells_.size()) * index(expansions_.local_stride));
  expansions_.moments = moments_.data();
  expansions_.locals = locals_.data();
  move_up(threads);
}

void CoulombTree::copy_points(const PointCharges<3>& points, Threads threads) {
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_, &field_[0], &field_[1], &field_[2]})
    values->resize(index(points.n));
  for_each_block(threads, {0, points.n}, 4096, [&](Rows rows) {
    for (int k = rows.first; k < rows.last; ++k) {
      const int i = source(k);
      for (std::size_t e = 0; e < 3; ++e) r_[e][index(k)] = points.r[e][i];
      q_[index(k)] = points.q[i];
    }
  });
}

CellPoints CoulombTree::leaf_cell(int leaf) const {
  const Rows rows = cells_.leaf_points(leaf);
  return {{r_[0].data(), r_[1].data(), r_[2].data()}, q_.data(), rows.first, rows.size()};
}

void CoulombTree::move_up(Threads threads) {
  const int bottom = cells_.levels() - 1;
  const CellRange leaves = cells_.level(bottom);
  for_each_block(threads, {0, cells_.leaves()}, leaves_a_task, [&](Rows rows) {
    for (int k = rows.first; k < rows.last; ++k) kernels_->p2m(expansions_, leaves.first + k, leaf_cell(k));
  });
  for (int l = bottom - 1; l >= 0; --l) {
    const CellRange parents = cells_.level(l), children = cells_.level(l + 1);
    for_each_block(threads, {0, parents.last - parents.first}, cells_a_task, [&](Rows rows) {
      kernels_->m2m(expansions_, {parents.first + rows.first, parents.first + rows.last},
                    {children.first + 2 * rows.first, children.last});
    });
  }
}

std::vector<int> CoulombTree::leaves_of(Rows rows) const {
  if (order_.empty() || rows.size() == cells_.points()) {
    std::vector<int> all(index((rows.last + shape_.leaf - 1) / shape_.leaf - rows.first / shape_.leaf));
    std::iota(all.begin(), all.end(), rows.first / shape_.leaf);
    return all;
  }
  std::vector<int> some;
  for (int leaf = 0; leaf < cells_.leaves(); ++leaf)
    for (int i : points_of(leaf))
      if (i >= rows.first && i < rows.last) {
        some.push_back(leaf);
        break;
      }
  return some;
}

std::vector<int> CoulombTree::sample_leaves(int count) const {
  std::vector<int> sample;
  const int all = cells_.leaves();
  for (int k = 0; k < count; ++k) {
    const double jitter = 0.618033988749895 * k;  // golden ratio: no stride of the jet can be in step with it
    const int leaf = static_cast<int>((k + jitter - static_cast<int>(jitter)) * all / count);
    if (sample.empty() || sample.back() != leaf) sample.push_back(leaf);
  }
  return sample;
}

std::vector<int> CoulombTree::points_of(int leaf) const {
  const Rows rows = cells_.leaf_points(leaf);
  std::vector<int> points(index(rows.size()));
  for (int k = rows.first; k < rows.last; ++k) points[index(k - rows.first)] = source(k);
  return points;
}

Interactions CoulombTree::evaluate(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                                   Threads threads) {
  const std::span<const int> own = own_share(leaves);
  wanted_.assign(index(cells_.size()), 0);
  for (int l = 0; l < cells_.levels(); ++l)
    for (int leaf : own) wanted_[index(cells_.level(l).first + (leaf >> (cells_.levels() - 1 - l)))] = 1;

  const Interactions done = shape_.local ? local_expansions(threads) : barnes_hut(threads);
  if (shape_.local)
    for_each_block(threads, {0, static_cast<int>(own.size())}, leaves_a_task, [&](Rows some) {
      double* const E[3] = {field_[0].data(), field_[1].data(), field_[2].data()};
      for (int n = some.first; n < some.last; ++n)
        kernels_->l2p(expansions_, cells_.level(cells_.levels() - 1).first + own[index(n)],
                      leaf_cell(own[index(n)]), E);
    });
  gather(leaves);
  give(leaves, rows, field, threads);
  return done;
}

void CoulombTree::evaluate_directly(const std::vector<int>& leaves, const FieldArrays<3>& field,
                                    Threads threads) {
  const std::span<const int> own = own_share(leaves);
  const CellRange all = {0, cells_.points()};
  for_each_task(threads, static_cast<int>(own.size()), [&](int n) {
    double* const E[3] = {field_[0].data(), field_[1].data(), field_[2].data()};
    kernels_->p2p(leaf_cell(own[index(n)]), &all, 1, E);
  });
  gather(leaves);
  give(leaves, {all.first, all.last}, field, threads);
}

std::span<const int> CoulombTree::own_share(const std::vector<int>& leaves) const {
  const std::vector<int> borders = ranks_.borders({0, static_cast<int>(leaves.size())}, 1);
  const std::size_t first = index(borders[index(ranks_.rank())]),
                    last = index(borders[index(ranks_.rank() + 1)]);
  return std::span(leaves).subspan(first, last - first);
}

/// The field at the points of the leaves, packed leaf after leaf, goes from each rank to all.
void CoulombTree::gather(const std::vector<int>& leaves) {
  if (ranks_.size() == 1) return;
  std::vector<int> packed = {0};  // place of each leaf
  for (int leaf : leaves) packed.push_back(packed.back() + cells_.leaf_points(leaf).size());
  std::vector<int> borders = ranks_.borders({0, static_cast<int>(leaves.size())}, 1);
  for (int& b : borders) b = packed[index(b)];
  std::array<std::vector<double>, 3> values;
  for (auto& v : values) v.resize(index(packed.back()));
  const auto for_each_leaf = [&](auto&& copy) {
    for (std::size_t k = 0; k < leaves.size(); ++k)
      for (std::size_t e = 0; e < 3; ++e)
        copy(field_[e].data() + cells_.leaf_points(leaves[k]).first, values[e].data() + packed[k],
             packed[k + 1] - packed[k]);
  };
  for_each_leaf([](const double* field, double* value, int n) { std::copy_n(field, n, value); });
  ranks_.gather(std::array{values[0].data(), values[1].data(), values[2].data()}, borders);
  for_each_leaf([](double* field, const double* value, int n) { std::copy_n(value, n, field); });
}

void CoulombTree::give(const std::vector<int>& leaves, Rows rows, const FieldArrays<3>& field,
                       Threads threads) const {
  for_each_block(threads, {0, static_cast<int>(leaves.size())}, leaves_a_task, [&](Rows some) {
    for (int n = some.first; n < some.last; ++n) {
      const Rows points = cells_.leaf_points(leaves[index(n)]);
      for (int k = points.first; k < points.last; ++k) {
        const int i = source(k);
        if (i >= rows.first && i < rows.last)
          for (std::size_t e = 0; e < 3; ++e) field[e][i] = field_[e][index(k)];
      }
    }
  });
}

/// Neighbouring leaves are neighbouring points: one range of sources.
void CoulombTree::act_near(int leaf, std::span<const int> near) {
  std::vector<CellRange> sources;
  for (int k : near) {
    const Rows rows = cells_.leaf_points(k);
    if (!sources.empty() && sources.back().last == rows.first)
      sources.back().last = rows.last;
    else
      sources.push_back({rows.first, rows.last});
  }
  double* const E[3] = {field_[0].data(), field_[1].data(), field_[2].data()};
  const CellPoints target = leaf_cell(leaf);
  const int count = static_cast<int>(sources.size());
  if (!shape_.single) return kernels_->p2p(target, sources.data(), count, E);
  const int cell = cells_.level(cells_.levels() - 1).first + leaf;
  NearUnits unit = {{}, cells_.radius()[cell], charge_unit_};
  for (int e = 0; e < 3; ++e) unit.centre[e] = cells_.centre(e)[cell];
  if (!(unit.length > 0)) unit.length = 1;
  kernels_->p2p_single(target, sources.data(), count, unit, E);
}

Interactions CoulombTree::local_expansions(Threads threads) {
  struct Task {
    int level, cell;
    std::vector<int> sources;  ///< far cells of one target cell above the cut, or candidates of a subtree
    bool subtree;
  };
  int cut = 0;
  while (cut < cells_.levels() - 1 && cells_.level(cut).last - cells_.level(cut).first < 64) ++cut;
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
      for (int k : leaves) count.pairs += cells_.leaf_points(leaf).size() * cells_.leaf_points(k).size();
    };
    if (task.subtree)
      Traversal(cells_, shape_.opening)
          .walk(task.level, task.cell, task.sources, -1, walked, far, near,
                [](int, int, std::span<const int>) {});
    else
      far(task.cell, task.sources);
  });
  move_down(threads);
  return std::accumulate(done.begin(), done.end(), Interactions{}, [](Interactions a, const Interactions& b) {
    return Interactions{a.pairs + b.pairs, a.expansions + b.expansions};
  });
}

Interactions CoulombTree::count() const {
  const int root[] = {0};
  Interactions work;
  Traversal(cells_, shape_.opening)
      .walk(
          0, 0, root, -1, [](int) { return true; },
          [&](int, std::span<const int> far) {
            work.expansions += static_cast<int>((far.size() + 7) / 8 * 8);
          },
          [&](int leaf, std::span<const int> near) {
            for (int k : near) work.pairs += cells_.leaf_points(leaf).size() * cells_.leaf_points(k).size();
          },
          [](int, int, std::span<const int>) {});
  return work;
}

void CoulombTree::move_down(Threads threads) {
  for (int l = 0; l + 1 < cells_.levels(); ++l) {
    const CellRange parents = cells_.level(l), children = cells_.level(l + 1);
    for_each_block(threads, {0, parents.last - parents.first}, cells_a_task, [&](Rows rows) {
      // runs of wanted parents; a cell that is not wanted has no local series
      for (int k = rows.first; k < rows.last; ++k) {
        if (!wanted(parents.first + k)) continue;
        const int first = k;
        while (k < rows.last && wanted(parents.first + k)) ++k;
        kernels_->l2l(expansions_, {parents.first + first, parents.first + k},
                      {children.first + 2 * first, std::min(children.last, children.first + 2 * k)});
      }
    });
  }
}

/// The textbook: each point walks the tree by itself; a cell acts by its moments if r_A < opening * distance.
Interactions CoulombTree::barnes_hut(Threads threads) {
  const int bottom = cells_.levels() - 1;
  const CellRange leaves = cells_.level(bottom);
  std::vector<Interactions> done(index(cells_.leaves()));
  for_each_task(threads, cells_.leaves(), [&](int leaf) {
    if (!wanted(leaves.first + leaf)) return;
    const Rows rows = cells_.leaf_points(leaf);
    for (int i = rows.first; i < rows.last; ++i) {
      Vector3 E{};
      std::vector<std::array<int, 2>> open = {{0, 0}};  // level, place in it
      while (!open.empty()) {
        const auto [level, k] = open.back();
        open.pop_back();
        const int cell = cells_.level(level).first + k;
        Vector3 d{};
        double d2 = 0;
        for (std::size_t e = 0; e < 3; ++e) {
          d[e] = r_[e][index(i)] - cells_.centre(static_cast<int>(e))[cell];
          d2 += d[e] * d[e];
        }
        const double radius = cells_.radius()[cell];
        if (radius * radius < shape_.opening * shape_.opening * d2) {
          Series M(shape_.order - 1);
          std::copy_n(expansions_.moments + static_cast<std::int64_t>(cell) * expansions_.moment_stride,
                      Series::terms(shape_.order - 1), M.data());
          const Vector3 far = m2p(M, d);
          for (std::size_t e = 0; e < 3; ++e) E[e] += far[e];
          ++done[index(leaf)].expansions;
        } else if (level == bottom) {
          const Rows near = cells_.leaf_points(k);
          done[index(leaf)].pairs += near.size();
          for (int j = near.first; j < near.last; ++j) {
            if (j == i) continue;
            double s2 = 0, s[3];
            for (std::size_t e = 0; e < 3; ++e) {
              s[e] = r_[e][index(i)] - r_[e][index(j)];
              s2 += s[e] * s[e];
            }
            for (std::size_t e = 0; e < 3; ++e) E[e] += q_[index(j)] * s[e] / (s2 * std::sqrt(s2));
          }
        } else {
          const CellRange next = cells_.level(level + 1);
          if (next.first + 2 * k + 1 < next.last) open.push_back({level + 1, 2 * k + 1});
          open.push_back({level + 1, 2 * k});
        }
      }
      for (std::size_t e = 0; e < 3; ++e) field_[e][index(i)] = E[e];
    }
  });
  return std::accumulate(done.begin(), done.end(), Interactions{}, [](Interactions a, const Interactions& b) {
    return Interactions{a.pairs + b.pairs, a.expansions + b.expansions};
  });
}

}  // namespace treejet
