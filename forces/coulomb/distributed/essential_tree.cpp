#include "forces/coulomb/distributed/essential_tree.hpp"

#include <algorithm>
#include <cmath>

#include "forces/coulomb/tree/multipole.hpp"
#include "forces/coulomb/tree/passes.hpp"
#include "forces/coulomb/tree/space_order.hpp"
#include "forces/coulomb/tree/traversal.hpp"

namespace treejet {

namespace {

/// Balls of all outlines together, and of one.
constexpr int all_balls = 8192, least_balls = 8, most_balls = 256;
/// Words of a ball on a card: centre, radius, largest critical radius of a leaf.
constexpr int ball_words = 5;
/// Words of a cell in a letter before its moments: centre, radii, children, points.
constexpr int header = 7;
/// Both sides of a condition are rounded.
constexpr double rounding = 1 - 1e-12;

}  // namespace

EssentialTree::EssentialTree(const Ranks& ranks, int ranks_together, Isa isa)
    : kernels_(&wide_kernels(isa)),
      ranks_(ranks),
      balls_(std::clamp(all_balls / ranks_together, least_balls, most_balls)) {}

void EssentialTree::plant(const PointCharges<3>& piece, const TreeShape& shape, Threads threads,
                          bool keep_order) {
  const bool same = order_.size() == index(piece.n) && leaf_ == shape.leaf && block_ == shape.block;
  own_ = Cells(piece.n, shape.leaf);
  block_ = shape.block;
  leaf_ = shape.leaf;
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
      Cell cell = {own_.radius()[level.first + k], 0, 0, 0, {}};
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
  history_.resize(cells_.size() * stride());
  locals_.resize(cells_.size() * index(expansions_.local_stride));
  view_expansions();
  roots_.clear();
  if (piece.n > 0) roots_.push_back(0);
  even_ = shape.even;
  equalise_errors(shape.opening, own_.spread(), threads);
  move_up(*kernels_, own_, expansions_, points(), threads);
}

void EssentialTree::equalise_errors(double opening, const Cells::Spread& among, Threads threads) {
  if (even_) own_.equalise_errors(expansions_.order, opening, among, threads);
  for (int k = 0; k < own_.size(); ++k) cells_[index(k)].critical_radius = own_.critical_radius()[k];
}

void EssentialTree::graft(double opening) {
  cells_.resize(index(own_.size()));
  for (auto& centre : centre_) centre.resize(cells_.size());
  history_.resize(cells_.size() * stride());
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_}) values->resize(index(own_.points()));
  roots_.resize(own_.points() > 0 ? 1 : 0);
  const Cells::Spread own = own_.spread();
  double all[] = {own.sum, own.leaves};
  ranks_.sum(all);
  equalise_errors(opening, {all[0], all[1]}, {1});
  if (ranks_.size() > 1) {
    const std::vector<double> cards = ranks_.of_all(card());
    Ranks::Letters letters(index(ranks_.size()));
    for (int k = 0; k < ranks_.size(); ++k)
      if (k != ranks_.rank()) letters[index(k)] = letter(cards.data() + index(k) * card_words(), opening);
    const Ranks::Letters received = ranks_.exchange(letters);
    make_room(received);
    for (int k = 0; k < ranks_.size(); ++k) {
      const double* card = cards.data() + index(k) * card_words();
      if (k == ranks_.rank() || card[0] == 0) continue;
      roots_.push_back(place());
      read(roots_.back(), received[index(k)].empty() ? card + root_on_card() : received[index(k)].data());
    }
    account(letters, received);
  }
  view_expansions();
}

void EssentialTree::view_expansions() {
  for (int e = 0; e < 3; ++e) expansions_.centre[e] = centre_[e].data();
  expansions_.moments = history_.data();
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

/// A card: the number of balls, the balls, the root as a closed cell.
std::size_t EssentialTree::root_on_card() const {
  return 1 + index(balls_) * ball_words;
}

std::size_t EssentialTree::card_words() const {
  return root_on_card() + header + stride();
}

EssentialTree::Message EssentialTree::card() const {
  Message card(root_on_card());
  if (own_.points() > 0) {
    write_outline(card.data());
    write_cell(0, 0, 0, card);
  }
  card.resize(card_words());
  return card;
}

EssentialTree::Message EssentialTree::letter(const double* card, double opening) const {
  Message letter;
  if (own_.points() == 0 || card[0] == 0) return letter;
  const int balls = static_cast<int>(card[0]);
  // most others are far as a whole, which takes one ball to see
  double whole[ball_words];
  std::copy_n(card + root_on_card(), ball_words - 1, whole);
  double& leaf_radius = whole[ball_words - 1] = 0;
  for (int k = 0; k < balls; ++k) leaf_radius = std::max(leaf_radius, card[ball_words * (k + 1)]);
  BoundaryTree other;
  other.add(whole, opening);
  if (closed(0, other)) return letter;
  other = {};
  for (int k = 0; k < balls; ++k) other.add(card + 1 + ball_words * k, opening);
  if (!closed(0, other)) write(0, other, letter);
  return letter;
}

/// The lowest level with few enough cells.
void EssentialTree::write_outline(double* at) const {
  const int bottom = own_.levels() - 1;
  int level = bottom;
  while (own_.level(level).last - own_.level(level).first > balls_) --level;
  const CellRange cells = own_.level(level), leaves = own_.level(bottom);
  *at++ = cells.last - cells.first;
  for (int k = cells.first; k < cells.last; ++k) {
    const int below = bottom - level, first = leaves.first + ((k - cells.first) << below);
    double leaf_radius = 0;
    for (int leaf = first; leaf < std::min(leaves.last, first + (1 << below)); ++leaf)
      leaf_radius = std::max(leaf_radius, cell(leaf).critical_radius);
    for (const auto& centre : centre_) *at++ = centre[index(k)];
    *at++ = cell(k).radius;
    *at++ = leaf_radius;
  }
}

void EssentialTree::BoundaryTree::add(const double* ball, double opening) {
  opening2 = rounding * opening * opening;
  for (int e = 0; e < 3; ++e) centre[e].push_back(ball[e]);
  reach.push_back(ball[4] + opening * ball[3]);
}

/// Whether no leaf in the balls can ask for what the cell is made of.
bool EssentialTree::closed(int k, const BoundaryTree& outline) const {
  const double x = centre_[0][index(k)], y = centre_[1][index(k)], z = centre_[2][index(k)];
  const double radius = cell(k).critical_radius;
  constexpr std::size_t together = 16;  // in wide registers, without a branch
  for (std::size_t first = 0; first < outline.reach.size(); first += together) {
    int near = 0;
    for (std::size_t b = first; b < std::min(first + together, outline.reach.size()); ++b) {
      const double dx = outline.centre[0][b] - x, dy = outline.centre[1][b] - y,
                   dz = outline.centre[2][b] - z;
      const double size = radius + outline.reach[b];
      near += !are_far(size, outline.opening2, dx * dx + dy * dy + dz * dz);
    }
    if (near > 0) return false;
  }
  return true;
}

void EssentialTree::write(int k, const BoundaryTree& outline, Message& letter) const {
  const Cell& c = cell(k);
  const bool open = !closed(k, outline);
  write_cell(k, open ? c.children : 0, open ? c.points.size() : 0, letter);
  for (int child = 0; open && child < c.children; ++child) write(c.child + child, outline, letter);
}

void EssentialTree::write_cell(int k, int children, int points, Message& letter) const {
  const double* moments = history_.data() + index(k) * stride();
  for (const auto& centre : centre_) letter.push_back(centre[index(k)]);
  letter.insert(letter.end(), {cell(k).radius, cell(k).critical_radius, double(children), double(points)});
  letter.insert(letter.end(), moments, moments + stride());
  for (const auto* values : {&r_[0], &r_[1], &r_[2], &q_}) {
    const auto first = values->begin() + cell(k).points.first;
    letter.insert(letter.end(), first, first + points);
  }
}

/// For what the letters bring at most: arrays that grow by doubling would hold the own piece twice.
void EssentialTree::make_room(const Ranks::Letters& letters) {
  std::size_t words = 0;
  for (const auto& letter : letters) words += letter.size();
  const std::size_t cells = cells_.size() + letters.size() + words / (header + stride());
  cells_.reserve(cells);
  history_.reserve(cells * stride());
  for (auto& centre : centre_) centre.reserve(cells);
  for (auto* values : {&r_[0], &r_[1], &r_[2], &q_}) values->reserve(values->size() + words / 4);
}

/// Room for one more cell; its number.
int EssentialTree::place() {
  cells_.push_back({});
  for (auto& centre : centre_) centre.push_back(0);
  history_.resize(cells_.size() * stride());
  return static_cast<int>(cells_.size()) - 1;
}

/// What `write` has written, into the place of the cell and places of its children; returns the end of it.
const double* EssentialTree::read(int k, const double* at) {
  for (std::size_t e = 0; e < 3; ++e) centre_[e][index(k)] = at[e];
  const int children = static_cast<int>(at[5]), points = static_cast<int>(at[6]),
            first = static_cast<int>(q_.size());
  cells_[index(k)] = {at[3], at[4], static_cast<int>(cells_.size()), children, {first, first + points}};
  at += header;
  std::copy_n(at, stride(), history_.data() + index(k) * stride());
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
  const std::size_t words = history_.capacity() + locals_.capacity() + 4 * q_.capacity() +
                            3 * centre_[0].capacity() + 5 * index(own_.size());
  return static_cast<std::int64_t>(words * sizeof(double) + cells_.capacity() * sizeof(Cell) +
                                   order_.capacity() * sizeof(int)) +
         letters_held_;
}

}  // namespace treejet
