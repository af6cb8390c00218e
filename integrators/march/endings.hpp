#pragma once
/// Beads whose column comes to an end (core/jet/columns.hpp): when they get there, and that they stay.
///
/// A bead has ended where its value is the end to the last bit. Before that its rate is smooth, beyond the
/// end, too, so that the instant can be found on the dense output like any other event. Scaled.

#include <algorithm>
#include <limits>
#include <vector>

#include "core/jet/columns.hpp"
#include "core/jet/jet.hpp"

namespace treejet {

template <int D>
class Endings {
 public:
  explicit Endings(const Columns& added) {
    constexpr double round_off = 1e-12;
    for (std::size_t k = 0; k < added.size(); ++k)
      if (added[k].end)
        columns_.push_back(
            {own_columns<D> + static_cast<Eigen::Index>(k), *added[k].end, round_off * added[k].small});
  }

  bool any() const { return !columns_.empty(); }

  /// By how much the farthest bead in `y` is past an end that it had not got to in `before`; negative if none
  /// is.
  double overdue(const State<D>& before, const State<D>& y) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const Ending& e : columns_)
      for (Eigen::Index i = 0; i < y.rows(); ++i)
        if (before(i, e.column) != e.value) most = std::max(most, e.value - y(i, e.column));
    return most;
  }

  /// Puts beads at an end, but for round-off or for what is `missing`, or beyond it there exactly. False if
  /// there was nothing to do.
  bool hold(State<D>& y, double missing = 0) const {
    bool moved = false;
    for (const Ending& e : columns_)
      for (double& value : y.col(e.column))
        if (value <= e.value + std::max(e.round_off, missing) && value != e.value) {
          value = e.value;
          moved = true;
        }
    return moved;
  }

 private:
  struct Ending {
    Eigen::Index column;
    double value, round_off;
  };
  std::vector<Ending> columns_;
};

}  // namespace treejet
