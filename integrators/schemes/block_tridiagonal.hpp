#pragma once
/// Linear systems of a chain: n rows of B-by-B blocks, each row coupled to the one before and the one after,
///
///     below_i u_{i-1} + diagonal_i u_i + above_i u_{i+1} = g_i ,      i = 0 ... n-1 ;
///
/// below_0 and above_{n-1} are not looked at. `factor` replaces the blocks by those of the LU factors, with
/// pivoting inside the diagonal blocks only; so the leading blocks must be well conditioned, as those of 1 -
/// h J are for a step h that resolves what grows. Work and memory O(n). Source: block Thomas algorithm; e.g.
/// Golub, Van Loan, "Matrix Computations", 4.5.

#include <Eigen/LU>
#include <vector>

namespace treejet {

template <int B>
class BlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, B, B>;
  using Column = Eigen::Matrix<double, B, 1>;

  struct Row {
    Block below, diagonal, above;
    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
  };
  std::vector<Row> row;

  void factor() {
    pivoted_.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) row[i].diagonal.noalias() -= row[i].below * row[i - 1].above;
      pivoted_[i].compute(row[i].diagonal);
      if (i + 1 < row.size()) row[i].above = pivoted_[i].solve(row[i].above).eval();
    }
  }

  /// Turns g, of one column or more, into u, after `factor`.
  template <class Columns>
  void solve(std::vector<Columns>& g) const {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) g[i].noalias() -= row[i].below * g[i - 1];
      g[i] = pivoted_[i].solve(g[i]).eval();
    }
    for (std::size_t i = row.size(); i-- > 1;) g[i - 1].noalias() -= row[i - 1].above * g[i];
  }

 private:
  std::vector<Eigen::PartialPivLU<Block>> pivoted_;
};

}  // namespace treejet
