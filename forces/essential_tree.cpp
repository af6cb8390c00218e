#include "forces/essential_tree.hpp"

#include <algorithm>
#include <cmath>

#include "forces/multipole.hpp"
#include "forces/space_order.hpp"
#include "forces/tree_passes.hpp"

namespace treejet {

namespace {

/// Balls of an outline: so many cells of one level, fewer of a small piece.
constexpr int balls = 32;
/// Words of a ball on a card: centre, radius, largest radius of a leaf.
constexpr int ball_words = 5;
/// Words of a cell in a letter before its moments: centre, radius, children, points.
constexpr int header = 6;
/// Both sides of a condition are rounded.
constexpr double rounding = 1 - 1e-12;

std::size_t index(int k) {
  return static_cast<std::size_t>(k);
}

double distance(const double* a, const double* b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

void EssentialTree::plant(const PointCharges<3>& piece, const TreeShape& shape, Threads threads,
                          bool keep_order) {
  const bool same = own_.points() == piece.n && own_.leaf() == shape.leaf && block_ == shape.block;
  own_ = Cells(piece.n, shape.leaf);
  block_ = shape.block;
  if (shape.block == 0 || piece.n == 0)
    order_.clear();
  else if (!same || !keep_order)
    order_ = space_order(piece.r.data(), piece.n, shape.leaf, shape.block, threads);
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_}) values->resize(index(piece.n));
  for (int k = 0; k < piece.n; ++k) {
    for (std::size_t e = 0; e < 3; ++e) r_[e][index(k)] = piece.r[e][source(k)];
    q_[index(k)] = piece.q[source(k)];
  }
  own_.enclose(points(), kernels_->reach, threads);

  cells_.clear();
  for (int l = 0; l < own_.levels(); ++l) {
    const CellRange level = own_.level(l);
    for (int k = 0; k < level.last - level.first; ++k) {
      Cell cell = {own_.radius()[level.first + k], 0, 0, {}};
      if (l == own_.levels() - 1)
        cell.points = own_.leaf_points(k);
      else
        cell.child = level.last + 2 * k, cell.children = std::min(2, own_.level(l + 1).last - cell.child);
      cells_.push_back(cell);
    }
  }
  for (int e = 0; e < 3; ++e) centre_[e].assign(own_.centre(e), own_.centre(e) + own_.size());
  expansions_.order = shape.order;
  expansions_.moment_stride = padded(Series::terms(shape.order - 1));
  expansions_.local_stride = padded(Series::terms(shape.order));
  moments_.resize(cells_.size() * stride());
  locals_.resize(cells_.size() * index(expansions_.local_stride));
  view_expansions();
  move_up(*kernels_, own_, expansions_, points(), threads);
}

void EssentialTree::graft(double opening) {
  cells_.resize(index(own_.size()));
  for (auto& centre : centre_) centre.resize(cells_.size());
  moments_.resize(cells_.size() * stride());
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_}) values->resize(index(own_.points()));
  roots_.clear();
  if (own_.points() > 0) roots_.push_back(0);
  if (ranks_.size() > 1) {
    const std::vector<double> all = cards();
    Ranks::Letters letters(index(ranks_.size()));
    for (int k = 0; k < ranks_.size(); ++k) {
      if (k == ranks_.rank() || own_.points() == 0) continue;
      const Outline other = outline(all.data() + index(k) * card_words());
      if (!other.empty() && !closed(0, other, opening)) write(0, other, opening, letters[index(k)]);
    }
    const Ranks::Letters received = ranks_.exchange(letters);
    for (int k = 0; k < ranks_.size(); ++k) {
      const double* card = all.data() + index(k) * card_words();
      if (k == ranks_.rank() || card[0] == 0) continue;
      roots_.push_back(place());
      read(roots_.back(),
           received[index(k)].empty() ? card + 1 + balls * ball_words : received[index(k)].data());
    }
    account(letters, received);
  }
  view_expansions();
}

void EssentialTree::view_expansions() {
  for (int e = 0; e < 3; ++e) expansions_.centre[e] = centre_[e].data();
  expansions_.moments = moments_.data();
  expansions_.locals = locals_.data();
}

CellPoints EssentialTree::points() const {
  return {{r_[0].data(), r_[1].data(), r_[2].data()}, q_.data(), 0, static_cast<int>(q_.size())};
}

double EssentialTree::distance2(int a, int b) const {
  double sum = 0;
  for (const auto& centre : centre_)
    sum += (centre[index(a)] - centre[index(b)]) * (centre[index(a)] - centre[index(b)]);
  return sum;
}

/// Of a card: the number of balls, the balls, the root as a closed cell.
std::size_t EssentialTree::card_words() const {
  return 1 + balls * ball_words + header + stride();
}

/// Of all ranks.
std::vector<double> EssentialTree::cards() const {
  std::vector<double> all(index(ranks_.size()) * card_words());
  double* own = all.data() + index(ranks_.rank()) * card_words();
  if (own_.points() > 0) {
    write_outline(own);
    Letter root;
    write_cell(0, 0, 0, root);
    std::copy(root.begin(), root.end(), own + 1 + balls * ball_words);
  }
  std::vector<int> borders;
  for (int k = 0; k <= ranks_.size(); ++k) borders.push_back(k * static_cast<int>(card_words()));
  double* const column[] = {all.data()};
  ranks_.gather(column, borders);
  return all;
}

/// The lowest level with few enough cells.
void EssentialTree::write_outline(double* at) const {
  const int bottom = own_.levels() - 1;
  int level = bottom;
  while (own_.level(level).last - own_.level(level).first > balls) --level;
  const CellRange cells = own_.level(level), leaves = own_.level(bottom);
  *at++ = cells.last - cells.first;
  for (int k = cells.first; k < cells.last; ++k) {
    const int below = bottom - level, first = leaves.first + ((k - cells.first) << below);
    double leaf_radius = 0;
    for (int leaf = first; leaf < std::min(leaves.last, first + (1 << below)); ++leaf)
      leaf_radius = std::max(leaf_radius, cell(leaf).radius);
    for (const auto& centre : centre_) *at++ = centre[index(k)];
    *at++ = cell(k).radius;
    *at++ = leaf_radius;
  }
}

EssentialTree::Outline EssentialTree::outline(const double* card) const {
  Outline found(static_cast<std::size_t>(card[0]));
  ++card;
  for (Ball& b : found) {
    b = {{card[0], card[1], card[2]}, card[3], card[4]};
    card += ball_words;
  }
  return found;
}

/// Whether no leaf within the outline can ask for what the cell is made of.
bool EssentialTree::closed(int k, const Outline& outline, double opening) const {
  const double centre[3] = {centre_[0][index(k)], centre_[1][index(k)], centre_[2][index(k)]};
  return std::all_of(outline.begin(), outline.end(), [&](const Ball& b) {
    return cell(k).radius + b.leaf_radius < rounding * opening * (distance(centre, b.centre) - b.radius);
  });
}

void EssentialTree::write(int k, const Outline& outline, double opening, Letter& letter) const {
  const Cell& c = cell(k);
  const bool open = !closed(k, outline, opening);
  write_cell(k, open ? c.children : 0, open ? c.points.size() : 0, letter);
  for (int child = 0; open && child < c.children; ++child) write(c.child + child, outline, opening, letter);
}

void EssentialTree::write_cell(int k, int children, int points, Letter& letter) const {
  const double* moments = moments_.data() + index(k) * stride();
  for (const auto& centre : centre_) letter.push_back(centre[index(k)]);
  letter.insert(letter.end(), {cell(k).radius, double(children), double(points)});
  letter.insert(letter.end(), moments, moments + stride());
  for (const auto* values : {&r_[0], &r_[1], &r_[2], &q_}) {
    const auto first = values->begin() + cell(k).points.first;
    letter.insert(letter.end(), first, first + points);
  }
}

/// Room for one more cell; its number.
int EssentialTree::place() {
  cells_.push_back({});
  for (auto& centre : centre_) centre.push_back(0);
  moments_.resize(cells_.size() * stride());
  return static_cast<int>(cells_.size()) - 1;
}

/// What `write` has written, into the place of the cell and places of its children; returns the end of it.
const double* EssentialTree::read(int k, const double* at) {
  for (std::size_t e = 0; e < 3; ++e) centre_[e][index(k)] = at[e];
  const int children = static_cast<int>(at[4]), points = static_cast<int>(at[5]),
            first = static_cast<int>(q_.size());
  cells_[index(k)] = {at[3], static_cast<int>(cells_.size()), children, {first, first + points}};
  at += header;
  std::copy_n(at, stride(), moments_.data() + index(k) * stride());
  at += stride();
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_}) {
    values->insert(values->end(), at, at + points);
    at += points;
  }
  for (int child = 0; child < children; ++child) place();
  for (int child = cell(k).child, end = child + children; child < end; ++child) at = read(child, at);
  return at;
}

void EssentialTree::account(const Ranks::Letters& out, const Ranks::Letters& in) {
  const auto bytes = [](const Ranks::Letters& letters) {
    std::size_t words = 0;
    for (const auto& l : letters) words += l.size();
    return static_cast<std::int64_t>(words * sizeof(double));
  };
  const auto card = static_cast<std::int64_t>(card_words() * sizeof(double));
  const std::int64_t others = ranks_.size() - 1;
  traffic_ = {bytes(out) + others * card, bytes(in) + others * card,
              static_cast<int>(cells_.size()) - own_.size(), static_cast<int>(q_.size()) - own_.points(), 0};
  for (const auto& letter : in) traffic_.partners += !letter.empty();
  letters_held_ = bytes(out) + bytes(in) + 2 * ranks_.size() * card;
}

std::int64_t EssentialTree::bytes() const {
  const std::size_t words = moments_.capacity() + locals_.capacity() + 4 * q_.capacity() +
                            3 * centre_[0].capacity() + 5 * index(own_.size());
  return static_cast<std::int64_t>(words * sizeof(double) + cells_.capacity() * sizeof(Cell) +
                                   order_.capacity() * sizeof(int)) +
         letters_held_;
}

}  // namespace treejet
