#include "forces/space_order.hpp"

#include <algorithm>
#include <bit>
#include <limits>

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

/// `leaf` blocks to a leaf; the left part takes the leaves of a full subtree, as in Cells.
void sort(Block* first, Block* last, unsigned leaf) {
  const auto leaves = (static_cast<unsigned>(last - first) + leaf - 1) / leaf;
  if (leaves <= 1) return;
  Block* middle = first + std::bit_ceil(leaves) / 2 * leaf;
  const int e = longest_side(first, last);
  std::nth_element(first, middle, last, [e](const Block& a, const Block& b) {
    return a.centre[e] != b.centre[e] ? a.centre[e] < b.centre[e] : a.first < b.first;
  });
  sort(first, middle, leaf);
  sort(middle, last, leaf);
}

}  // namespace

std::vector<int> space_order(const double* const* r, int n, int leaf, int block) {
  std::vector<Block> all = blocks(r, n, block);
  sort(all.data(), all.data() + all.size(), static_cast<unsigned>(leaf / block));
  std::vector<int> order;
  order.reserve(static_cast<std::size_t>(n));
  for (const Block& b : all)
    for (int i = b.first; i < std::min(n, b.first + block); ++i) order.push_back(i);
  return order;
}

}  // namespace treejet
