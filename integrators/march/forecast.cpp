#include "integrators/march/forecast.hpp"

#include <algorithm>

namespace treejet {

template <int D>
double Forecast<D>::next_event(const Jet<D>& jet, double horizon) const {
  double soonest = horizon;
  if (nozzle_.inserting()) {
    const double regular = rhythm_.next(jet.held).value_or(jet.t);
    soonest = regular > jet.t ? std::min(horizon, regular - jet.t) : time_to(true, jet, horizon);
  }
  return collector_.removing() ? time_to(false, jet, soonest) : soonest;
}

/// By the motion of the youngest or the oldest bead; `horizon` if that is sooner.
template <int D>
double Forecast<D>::time_to(bool insertion, const Jet<D>& jet, double horizon) const {
  const Eigen::Index i = insertion ? jet.y.rows() - 1 : 0;
  const auto& jerk = insertion ? youngest_jerk_ : oldest_jerk_;
  const Vec<D> r = position<D>(jet.y, i), v = velocity<D>(jet.y, i), a = velocity<D>(jet.slope, i);
  const auto overdue = [&](double s) {
    Vec<D> ahead = r + s * (v + s / 2 * a);
    if (jerk) ahead += s * s * s / 6 * *jerk;
    return insertion ? nozzle_.overdue(jet, ahead, jet.t + s) : collector_.overdue(ahead[0]);
  };
  double low = 0, high = horizon, g_low = overdue(low), g_high = overdue(high);
  if (!(g_low < 0 && g_high >= 0)) return horizon;
  for (int k = 0; k < 30 && high - low > 1e-9 * horizon; ++k) {
    const double s = low + (high - low) * std::clamp(g_low / (g_low - g_high), 0.01, 0.99), g_s = overdue(s);
    (g_s < 0 ? low : high) = s;
    (g_s < 0 ? g_low : g_high) = g_s;
  }
  return high;
}

template <int D>
void Forecast<D>::segment(const Jet<D>&, const DenseOutput<D>& segment) {
  youngest_jerk_ = segment.jerk_at_end(segment.first().rows() - 1);
  oldest_jerk_ = segment.jerk_at_end(0);
}

template <int D>
void Forecast<D>::event(EventKind kind, const Jet<D>& jet) {
  if (kind == EventKind::removal) return oldest_jerk_.reset();
  const bool release = kind == EventKind::release;
  rhythm_.insertion(release, jet.t);
  // a held bead's charge rises slowly at first: at a placement the jerk of the youngest bead goes on
  if (release) youngest_jerk_.reset();
}

template class Forecast<1>;
template class Forecast<3>;

}  // namespace treejet
