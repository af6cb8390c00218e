#include "forces/coulomb/tree/space_order.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace treejet {

namespace {

struct Block {
  double centre[3];
  int first;
};

std::vector<Block> blocks(const double* const* r, int n, int block) {
  std::vector<Block> all;
  all.reserve(static_cast<std::size_t>(n / block + 1));
  for (int first = 0; first < n; first += block) {
    const int last = std::min(n, first + block) - 1;
    all.push_back({{}, first});
    for (int e = 0; e < 3; ++e) all.back().centre[e] = 0.5 * (r[e][first] + r[e][last]);
  }
  return all;
}

int longest_side(const Block* first, const Block* last) {
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  for (const Block* b = first; b != last; ++b)
    for (int e = 0; e < 3; ++e) {
      low[e] = std::min(low[e], b->centre[e]);
      high[e] = std::max(high[e], b->centre[e]);
    }
  int longest = 0;
  for (int e = 1; e < 3; ++e)
    if (high[e] - low[e] > high[longest] - low[longest]) longest = e;
  return longest;
}

/// Where a box is cut: the left part takes the leaves (of `leaf` blocks) of a full subtree, as in Cells.
/// `last` if the box is a leaf itself.
Block* cut(Block* first, Block* last, unsigned leaf) {
  const auto leaves = (static_cast<unsigned>(last - first) + leaf - 1) / leaf;
  if (leaves <= 1) return last;
  Block* middle = first + std::bit_ceil(leaves) / 2 * leaf;
  const int e = longest_side(first, last);
  std::nth_element(first, middle, last, [e](const Block& a, const Block& b) {
    return a.centre[e] != b.centre[e] ? a.centre[e] < b.centre[e] : a.first < b.first;
  });
  return middle;
}

void sort(Block* first, Block* last, unsigned leaf) {
  Block* middle = cut(first, last, leaf);
  if (middle == last) return;
  sort(first, middle, leaf);
  sort(middle, last, leaf);
}

/// The same on threads: level by level until there are boxes enough for everyone.
void sort(Block* first, Block* last, unsigned leaf, Threads threads) {
  constexpr std::size_t enough = 32;
  std::vector<std::pair<Block*, Block*>> boxes = {{first, last}};
  while (threads.count > 1 && boxes.size() < enough) {
    std::vector<Block*> middle(boxes.size());
    for_each_task(threads, static_cast<int>(boxes.size()), [&](int k) {
      const auto box = static_cast<std::size_t>(k);
      middle[box] = cut(boxes[box].first, boxes[box].second, leaf);
    });
    std::vector<std::pair<Block*, Block*>> halves;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      halves.push_back({boxes[k].first, middle[k]});
      if (middle[k] != boxes[k].second) halves.push_back({middle[k], boxes[k].second});
    }
    if (halves.size() == boxes.size()) return;
    boxes = std::move(halves);
  }
  for_each_task(threads, static_cast<int>(boxes.size()), [&](int k) {
    sort(boxes[static_cast<std::size_t>(k)].first, boxes[static_cast<std::size_t>(k)].second, leaf);
  });
}

}  // namespace

std::vector<int> space_order(const double* const* r, int n, int leaf, int block, Threads threads) {
  std::vector<Block> all = blocks(r, n, block);
  sort(all.data(), all.data() + all.size(), static_cast<unsigned>(leaf / block), threads);
  std::vector<int> order;
  order.reserve(static_cast<std::size_t>(n));
  for (const Block& b : all)
    for (int i = b.first; i < std::min(n, b.first + block); ++i) order.push_back(i);
  return order;
}

}  // namespace treejet
