#include "forces/coulomb/tree/essential_tree.hpp"

#include <algorithm>

#include "forces/coulomb/tree/traversal.hpp"

namespace treejet {

namespace {

using Message = EssentialTree::Message;

/// Balls of all boundary trees together, and of one.
constexpr int all_balls = 8192, least_balls = 8, most_balls = 256;
/// Words of a ball in a summary: centre, radius, largest critical radius of a leaf.
constexpr int ball_words = 5;
/// Words of a cell in a message before its moments: centre, radii, children, points.
constexpr int header = 7;
/// Both sides of a condition are rounded.
constexpr double rounding = 1 - 1e-12;

/// Balls that hold a subdomain, for an opening: centres, and how far from a ball a cell of radius 0 must be
/// to be far from all leaves in it, times the opening.
class BoundaryTree {
 public:
  explicit BoundaryTree(double opening) : opening_(opening) {}

  void add(const double* ball) {
    for (int e = 0; e < 3; ++e) centre_[e].push_back(ball[e]);
    reach_.push_back(ball[4] + opening_ * ball[3]);
  }

  /// Whether no leaf in the balls can ask for what the cell is made of.
  bool closes(const Cells& cells, int cell) const {
    const double x = cells.centre(0)[cell], y = cells.centre(1)[cell], z = cells.centre(2)[cell];
    const double radius = cells.critical_radius()[cell], opening2 = rounding * opening_ * opening_;
    constexpr std::size_t together = 16;  // in wide registers, without a branch
    for (std::size_t first = 0; first < reach_.size(); first += together) {
      int near = 0;
      for (std::size_t b = first; b < std::min(first + together, reach_.size()); ++b) {
        const double dx = centre_[0][b] - x, dy = centre_[1][b] - y, dz = centre_[2][b] - z;
        near += !are_far(radius + reach_[b], opening2, dx * dx + dy * dy + dz * dz);
      }
      if (near > 0) return false;
    }
    return true;
  }

 private:
  double opening_;
  std::vector<double> centre_[3], reach_;
};

/// The balls of the lowest level with few enough cells, behind their number.
void write_boundary(const Cells& cells, int balls, double* at) {
  const int bottom = cells.levels() - 1;
  int level = bottom;
  while (cells.level(level).last - cells.level(level).first > balls) --level;
  const CellRange all = cells.level(level), leaves = cells.level(bottom);
  *at++ = all.last - all.first;
  for (int k = all.first; k < all.last; ++k) {
    const int below = bottom - level, first = leaves.first + ((k - all.first) << below);
    double leaf_radius = 0;
    for (int leaf = first; leaf < std::min(leaves.last, first + (1 << below)); ++leaf)
      leaf_radius = std::max(leaf_radius, cells.critical_radius()[leaf]);
    for (int e = 0; e < 3; ++e) *at++ = cells.centre(e)[k];
    *at++ = cells.radius()[k];
    *at++ = leaf_radius;
  }
}

/// A cell that shows so many children and points.
void write_cell(const Tree& tree, int cell, int children, Rows points, Message& message) {
  const Cells& cells = tree.cells;
  const double* moments = tree.moments.data() + index(cell) * tree.moment_stride();
  for (int e = 0; e < 3; ++e) message.push_back(cells.centre(e)[cell]);
  message.insert(message.end(), {cells.radius()[cell], cells.critical_radius()[cell], double(children),
                                 double(points.size())});
  message.insert(message.end(), moments, moments + tree.moment_stride());
  for (const auto* values : tree.points.columns())
    message.insert(message.end(), values->begin() + points.first, values->begin() + points.last);
}

/// A cell, and below it all that a leaf inside the boundary may ask for.
void write(const Tree& tree, int cell, const BoundaryTree& boundary, Message& message) {
  const Cells& cells = tree.cells;
  if (boundary.closes(cells, cell)) return write_cell(tree, cell, 0, {}, message);
  if (!cells.opens(cell)) return write_cell(tree, cell, 0, cells.points_of(cell), message);
  const CellRange children = cells.opened(cell);
  write_cell(tree, cell, children.last - children.first, {}, message);
  for (int child = children.first; child < children.last; ++child) write(tree, child, boundary, message);
}

/// What `write` has written, into the place of the cell and places of its children; returns the end of it.
const double* read(Tree& tree, int cell, const double* at) {
  const int children = static_cast<int>(at[5]), points = static_cast<int>(at[6]), first = tree.points.all();
  const int child = tree.cells.add(children);
  tree.cells.set(cell,
                 {{at[0], at[1], at[2]}, at[3], at[4], {child, child + children}, {first, first + points}});
  at += header;
  tree.moments.resize(index(tree.cells.all()) * tree.moment_stride());
  std::copy_n(at, tree.moment_stride(), tree.moments.data() + index(cell) * tree.moment_stride());
  at += tree.moment_stride();
  for (auto* values : tree.points.columns()) {
    values->insert(values->end(), at, at + points);
    at += points;
  }
  for (int k = child; k < child + children; ++k) at = read(tree, k, at);
  return at;
}

void prune(Tree& tree) {
  tree.cells.prune();
  tree.moments.resize(index(tree.cells.size()) * tree.moment_stride());
  for (auto* values : tree.points.columns()) values->resize(index(tree.points.size()));
}

/// For what the messages bring at most: arrays that grow by doubling would hold the own subdomain twice.
void make_room(Tree& tree, const Ranks::Messages& messages) {
  std::size_t words = 0;
  for (const auto& message : messages) words += message.size();
  const std::size_t cells =
      index(tree.cells.size()) + messages.size() + words / (header + tree.moment_stride());
  tree.cells.reserve(cells);
  tree.moments.reserve(cells * tree.moment_stride());
  for (auto* values : tree.points.columns()) values->reserve(values->size() + words / 4);
}

}  // namespace

EssentialTree::EssentialTree(const Ranks& subdomains, int ranks_together)
    : ranks_(subdomains), balls_(std::clamp(all_balls / ranks_together, least_balls, most_balls)) {}

void EssentialTree::graft(Tree& tree, double opening) {
  if (ranks_.size() == 1) return;
  prune(tree);
  const std::vector<double> summaries = ranks_.of_all(summary(tree));
  const auto summary_of = [&](int rank) { return summaries.data() + index(rank) * summary_words(tree); };
  Ranks::Messages out(index(ranks_.size()));
  for (int k = 0; k < ranks_.size(); ++k)
    if (k != ranks_.rank()) out[index(k)] = message(tree, summary_of(k), opening);
  const Ranks::Messages in = ranks_.exchange(out);
  make_room(tree, in);
  for (int k = 0; k < ranks_.size(); ++k) {
    const bool empty = summary_of(k)[0] == 0;
    if (k == ranks_.rank() || empty) continue;
    read(tree, tree.cells.add_root(),
         in[index(k)].empty() ? summary_of(k) + root_in_summary() : in[index(k)].data());
  }
  account(tree, out, in);
}

/// A summary: the number of balls, the balls, the root as a closed cell.
std::size_t EssentialTree::root_in_summary() const {
  return 1 + index(balls_) * ball_words;
}

std::size_t EssentialTree::summary_words(const Tree& tree) const {
  return root_in_summary() + header + tree.moment_stride();
}

EssentialTree::Message EssentialTree::summary(const Tree& tree) const {
  Message summary(root_in_summary());
  if (tree.points.size() > 0) {
    write_boundary(tree.cells, balls_, summary.data());
    write_cell(tree, 0, 0, {}, summary);
  }
  summary.resize(summary_words(tree));
  return summary;
}

EssentialTree::Message EssentialTree::message(const Tree& tree, const double* summary, double opening) const {
  Message message;
  if (tree.points.size() == 0 || summary[0] == 0) return message;
  const int balls = static_cast<int>(summary[0]);
  // most others are far as a whole, which takes one ball to see
  double whole[ball_words];
  std::copy_n(summary + root_in_summary(), ball_words - 1, whole);
  double& leaf_radius = whole[ball_words - 1] = 0;
  for (int k = 0; k < balls; ++k) leaf_radius = std::max(leaf_radius, summary[ball_words * (k + 1)]);
  BoundaryTree ball(opening);
  ball.add(whole);
  if (ball.closes(tree.cells, 0)) return message;
  BoundaryTree boundary(opening);
  for (int k = 0; k < balls; ++k) boundary.add(summary + 1 + ball_words * k);
  if (!boundary.closes(tree.cells, 0)) write(tree, 0, boundary, message);
  return message;
}

void EssentialTree::account(const Tree& tree, const Ranks::Messages& out, const Ranks::Messages& in) {
  const auto bytes = [](const Ranks::Messages& messages) {
    std::size_t words = 0;
    for (const auto& message : messages) words += message.size();
    return static_cast<std::int64_t>(words * sizeof(double));
  };
  const auto summary = static_cast<std::int64_t>(summary_words(tree) * sizeof(double));
  const std::int64_t others = ranks_.size() - 1;
  traffic_ = {bytes(out) + others * summary, bytes(in) + others * summary,
              tree.cells.all() - tree.cells.size(), tree.points.all() - tree.points.size(), 0};
  for (const auto& message : in) traffic_.partners += !message.empty();
  bytes_ = bytes(out) + bytes(in) + 2 * ranks_.size() * summary;
}

}  // namespace treejet
