#include "forces/coulomb/tree/essential_tree.hpp"

#include <algorithm>

namespace treejet {

namespace {

using Message = EssentialTree::Message;

/// Balls of a rank's boundary tree. The fewer the ranks, the longer their subdomains, and the more balls pay.
constexpr int all_balls = 8192, least_balls = 16, most_balls = 256;
/// Words of a cell in a message before its moments: centre, radii, children, points.
constexpr int header = 7;

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

/// Whether no leaf inside the boundary asks for more of a cell than its moments.
bool is_closed(const Cells& cells, int cell, const BoundaryTree& boundary) {
  return boundary.closes({cells.centre(0)[cell], cells.centre(1)[cell], cells.centre(2)[cell]},
                         cells.critical_radius()[cell]);
}

/// A cell, and below it all that a leaf inside the boundary may ask for.
void write(const Tree& tree, int cell, const BoundaryTree& boundary, Message& message) {
  const Cells& cells = tree.cells;
  if (is_closed(cells, cell, boundary)) return write_cell(tree, cell, 0, {}, message);
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

/// A cell that shows nothing but its moments.
void graft_closed(Tree& tree, const Summary& s) {
  const int cell = tree.cells.add_root(), none = tree.points.all();
  const double(&at)[3] = s.whole.centre;
  tree.cells.set(cell, {{at[0], at[1], at[2]}, s.whole.radius, s.critical_radius, {}, {none, none}});
  tree.moments.insert(tree.moments.end(), s.moments.begin(), s.moments.end());
}

void prune(Tree& tree) {
  tree.cells.prune();
  tree.moments.resize(index(tree.cells.size()) * tree.moment_stride());
  for (auto* values : tree.points.columns()) values->resize(index(tree.points.size()));
}

/// For what messages of so many words bring at most, and so many closed cells: arrays that grow by doubling
/// would hold the own subdomain twice.
void make_room(Tree& tree, std::size_t words, std::size_t closed) {
  const std::size_t cells = index(tree.cells.size()) + closed + words / (header + tree.moment_stride());
  tree.cells.reserve(cells);
  tree.moments.reserve(cells * tree.moment_stride());
  for (auto* values : tree.points.columns()) values->reserve(values->size() + words / 4);
}

std::int64_t bytes_of(const Message& message) {
  return static_cast<std::int64_t>(message.size() * sizeof(double));
}

}  // namespace

void EssentialTree::graft(Tree& tree, const TreeShape& shape, const WideKernels& kernels) {
  if (ranks_.size() == 1) return;
  prune(tree);
  traffic_ = {};
  summaries_.begin(own_summary(tree, ranks_.size()), shape, kernels);
  exchange_summaries();
  for (const SummaryTree::Near& near : summaries_.near())
    send(near.group, message(tree, near.summary, shape.opening));
  std::vector<Message> in;
  std::size_t words = 0;
  for (const SummaryTree::Near& near : summaries_.near())
    words += in.emplace_back(receive(near.group)).size();
  make_room(tree, words, summaries_.far().size() + in.size());
  for (const Summary& far : summaries_.far()) graft_closed(tree, far);
  for (std::size_t k = 0; k < in.size(); ++k)
    if (in[k].empty())
      graft_closed(tree, summaries_.near()[k].summary);
    else
      read(tree, tree.cells.add_root(), in[k].data());
  traffic_.cells = tree.cells.all() - tree.cells.size();
  traffic_.points = tree.points.all() - tree.points.size();
  for (const Message& message : in) traffic_.partners += !message.empty();
  bytes_ = traffic_.sent + traffic_.received;
}

void EssentialTree::exchange_summaries() {
  for (int k = 0; k < summaries_.rounds(); ++k) {
    const SummaryTree::Round round = summaries_.round(k);
    for (const int rank : round.to) send(rank, round.message);
    std::vector<Message> in;
    for (const int rank : round.from) in.push_back(receive(rank));
    summaries_.take(k, in);
  }
}

void EssentialTree::send(int to, const Message& message) {
  traffic_.sent += bytes_of(message);
  ranks_.send(to, message);
}

Message EssentialTree::receive(int from) {
  Message message = ranks_.receive(from);
  traffic_.received += bytes_of(message);
  return message;
}

Summary EssentialTree::own_summary(const Tree& tree, int ranks) {
  return summary(tree, std::clamp(all_balls / ranks, least_balls, most_balls));
}

Message EssentialTree::message(const Tree& tree, const Summary& reader, double opening) {
  Message message;
  const BoundaryTree boundary(reader.balls, opening);
  if (!is_closed(tree.cells, 0, boundary)) write(tree, 0, boundary, message);
  return message;
}

}  // namespace treejet
