#pragma once
/// Block tridiagonal systems (block_tridiagonal.hpp) of a chain cut into contiguous subdomains, one on each
/// process, which solve together.
///
/// With A the rows of a subdomain alone, u_older and u_younger the unknowns next to it, below_0 in its first
/// row and above_{n-1} in its last one,
///
///     u = A^-1 g - W u_older - V u_younger ,
///     W = A^-1 (below_0, 0, ..., 0)' ,      V = A^-1 (0, ..., 0, above_{n-1})' .
///
/// The first and the last of these equations of each subdomain make a block tridiagonal system for the
/// unknowns at the cuts. Every process solves all of it: its work, and what is sent, grow with the number of
/// subdomains. The result differs from that of one subdomain by round-off. Sources: H. H. Wang, ACM Trans.
/// Math. Softw. 7 (1981) 170; E. Polizzi, A. H. Sameh, Parallel Comput. 32 (2006) 177.

#include <functional>
#include <span>

#include "integrators/schemes/block_tridiagonal.hpp"

namespace treejet {

template <int B>
class CutBlockTridiagonal {
 public:
  using Block = typename BlockTridiagonal<B>::Block;
  using Column = typename BlockTridiagonal<B>::Column;
  /// The numbers of all processes, in their order along the chain, from as many of each.
  using OfAll = std::function<std::vector<double>(std::span<const double> own)>;

  CutBlockTridiagonal(int place, OfAll of_all)
      : place_(static_cast<std::size_t>(place)), of_all_(std::move(of_all)) {}

  /// Replaces the rows of this subdomain, maybe none, by their factors, with which they stay until the last
  /// `solve`. The first below of the chain and its last above are not looked at.
  void factor(BlockTridiagonal<B>& own) {
    own_ = &own;
    const std::size_t n = own.row.size();
    W_.assign(n, Block::Zero());
    V_.assign(n, Block::Zero());
    if (n > 0) {
      W_.front() = own.row.front().below;
      V_.back() = own.row.back().above;
      own.factor();
      own.solve(W_);
      own.solve(V_);
    }
    gather_cuts();
    cuts_.factor();
  }

  /// Turns g into u, and appends the unknown that follows: zero at the end of the chain.
  void solve(std::vector<Column>& g) const {
    own_->solve(g);
    const std::vector<Pair> at_cuts = solve_cuts(g);
    if (g.empty()) return;
    const Column older = before_ > 0 ? Column(at_cuts[before_ - 1].template tail<B>()) : Column::Zero();
    const Column younger =
        before_ + 1 < at_cuts.size() ? Column(at_cuts[before_ + 1].template head<B>()) : Column::Zero();
    for (std::size_t i = 0; i < g.size(); ++i) g[i] -= W_[i] * older + V_[i] * younger;
    g.push_back(younger);
  }

 private:
  using Pair = Eigen::Matrix<double, 2 * B, 1>;  ///< the first and the last unknown of a subdomain
  static constexpr std::size_t of_block = Block::SizeAtCompileTime, numbers_of_cuts = 1 + 4 * of_block,
                               numbers_of_values = 2 * B;

  /// Of each subdomain whether it has rows, and W and V of its first and last one.
  void gather_cuts() {
    std::vector<double> mine(numbers_of_cuts, 0);
    if (!W_.empty()) {
      mine[0] = 1;
      double* to = &mine[1];
      for (const Block* block : {&W_.front(), &W_.back(), &V_.front(), &V_.back()}) {
        Eigen::Map<Block>{to} = *block;
        to += Block::SizeAtCompileTime;
      }
    }
    const std::vector<double> all = of_all_(mine);
    has_rows_.clear();
    cuts_.row.clear();
    for (std::size_t k = 0; k * numbers_of_cuts < all.size(); ++k) {
      const double* const from = &all[k * numbers_of_cuts];
      if (k == place_) before_ = cuts_.row.size();
      has_rows_.push_back(from[0] != 0);
      if (has_rows_.back()) cuts_.row.push_back(at_cut(from + 1));
    }
    // nobody is beyond the ends of the chain
    if (!cuts_.row.empty()) cuts_.row.front().below.setZero(), cuts_.row.back().above.setZero();
  }

  typename BlockTridiagonal<2 * B>::Row at_cut(const double* from) const {
    const auto next = [&from] {
      const Eigen::Map<const Block> block(from);
      from += Block::SizeAtCompileTime;
      return block;
    };
    typename BlockTridiagonal<2 * B>::Row row;
    row.below.setZero();
    row.diagonal.setIdentity();
    row.above.setZero();
    row.below.template topRightCorner<B, B>() = next();
    row.below.template bottomRightCorner<B, B>() = next();
    row.above.template topLeftCorner<B, B>() = next();
    row.above.template bottomLeftCorner<B, B>() = next();
    return row;
  }

  std::vector<Pair> solve_cuts(const std::vector<Column>& g) const {
    Pair mine = Pair::Zero();
    if (!g.empty()) mine << g.front(), g.back();
    const std::vector<double> all = of_all_({mine.data(), numbers_of_values});
    std::vector<Pair> values;
    for (std::size_t k = 0; k < has_rows_.size(); ++k)
      if (has_rows_[k]) values.emplace_back(&all[k * numbers_of_values]);
    cuts_.solve(values);
    return values;
  }

  std::size_t place_;
  OfAll of_all_;
  const BlockTridiagonal<B>* own_ = nullptr;
  std::vector<Block> W_, V_;
  std::vector<bool> has_rows_;    ///< a process
  std::size_t before_ = 0;        ///< subdomains with rows that are older than this one
  BlockTridiagonal<2 * B> cuts_;  ///< of those with rows
};

}  // namespace treejet
