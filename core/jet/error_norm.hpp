#pragma once
/// The local error of a step as one number, over what the tolerance lets a step have:
///
///     max over beads of ( |e_r| / L_step ,  |e_v| / (L_step / T + |v|) ,  |e_sigma| / (1 / T + |sigma|) ,
///                         |e_c| / (small_c + |c|) )  / min( allowance * tolerance, most ) ,
///
/// e the error estimate of the embedded pair, components in the maximum norm, all scaled. Position counts by
/// the element length, velocity by the bead's own speed (at least an element length in the time T), stress by
/// its own size (at least what the strain rate 1 / T makes), an added column c by its own size (at least what
/// it declares as small, core/jet/columns.hpp), so that neither the spacing nor the voltage
/// changes what a tolerance buys. T is the relaxation time, or the interval of beads if that is longer: in a
/// fluid that is all but Newtonian nothing is as fast as it relaxes. A maximum, not a mean: nearly all of the
/// error sits on the youngest bead, where an average over the chain would hide it.
///
/// The allowance is a choice of scale: with it the position of no bead of the paper's case 3 errs by more
/// than 16 tolerances of the collector distance when the jet arrives there, 64 of them once it whips, with
/// any scheme (core/jet/schemes.hpp). `most` keeps a step from following another solution.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/vec.hpp"
#include "core/jet/columns.hpp"
#include "core/jet/parameters.hpp"

namespace treejet {

class ErrorNorm {
 public:
  /// Without a tolerance nothing is estimated, nor asked for here.
  explicit ErrorNorm(const Parameters& p, const Columns& added = {});

  /// Of the error e of the table y (core/base/vec.hpp).
  template <int D>
  double operator()(const State<D>& e, const State<D>& y) const {
    if (y.rows() == 0) return 0;
    const auto v = y.template middleCols<D>(velocity_column<D>).abs();
    const auto sigma = y.col(stress_column<D>).abs();
    const double length = e.template leftCols<D>().abs().maxCoeff() / length_;
    const double speed = (e.template middleCols<D>(velocity_column<D>).abs().rowwise().maxCoeff() /
                          (velocity_ + v.rowwise().maxCoeff()))
                             .maxCoeff();
    const double stress = (e.col(stress_column<D>).abs() / (stress_ + sigma)).maxCoeff();
    // a maximum would let a NaN pass
    if (!std::isfinite(e.sum())) return std::numeric_limits<double>::quiet_NaN();
    double added = 0;
    for (Eigen::Index k = 0; k < y.added(); ++k) {
      const Eigen::Index column = own_columns<D> + k;
      const double small = small_.at(static_cast<std::size_t>(k));
      added = std::max(added, (e.col(column).abs() / (small + y.col(column).abs())).maxCoeff());
    }
    return std::max({length, speed, stress, added}) / permitted_;
  }

  double tolerance() const { return tolerance_; }

 private:
  double length_, velocity_, stress_;  ///< scaled, what counts as small
  double tolerance_, permitted_;
  std::vector<double> small_;  ///< of the added columns
};

}  // namespace treejet
