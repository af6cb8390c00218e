#pragma once
/// Who works at the rows of a long table, or at the chunks of a file, for algebra and files that know no
/// threads: one after the other, unless a run puts in its place what shares them out.

#include <Eigen/Core>
#include <functional>

namespace treejet {

/// Calls a function on stretches of rows, `first` and `count`, that cover all of them, maybe at the same
/// time. Where a stretch begins must not matter to the bits of its rows.
using RowSharing = std::function<void(
    Eigen::Index rows, const std::function<void(Eigen::Index first, Eigen::Index count)>& of_stretch)>;

inline void all_at_once(Eigen::Index rows,
                        const std::function<void(Eigen::Index first, Eigen::Index count)>& of_stretch) {
  of_stretch(0, rows);
}

/// Tables with fewer rows are not worth it, and are one stretch.
constexpr Eigen::Index rows_worth_sharing = 16'384;

template <class OfStretch>
void for_each_stretch(const RowSharing& rows_shared, Eigen::Index rows, const OfStretch& of_stretch) {
  if (rows < rows_worth_sharing)
    of_stretch(0, rows);
  else
    rows_shared(rows, of_stretch);
}

}  // namespace treejet
