#include "core/observe/plausibility.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/deck/lab_sheet.hpp"
#include "core/observe/progress.hpp"

namespace treejet {

namespace {
constexpr int steps_a_look = 64;
constexpr int enough_beads = 100;  // released, for a rate that is no accident of the beginning
}  // namespace

template <int D>
Plausibility<D>::Plausibility(const Parameters& p, const Nozzle<D>& nozzle)
    : unit_(scales(p)),
      behind_(-p.nozzle_cross),
      distance_(p.collector_distance),
      supply_(nozzle.inserting() && p.feed == Feed::pull ? p.nozzle_velocity / unit_.l_step : 0) {}

/// The jet at the beginning of a step is that at the end of another.
template <int D>
void Plausibility<D>::segment(const Jet<D>& jet, const DenseOutput<D>& segment) {
  if (++steps_ % steps_a_look == 0) look(jet, segment.begin());
}

template <int D>
void Plausibility<D>::look(const Jet<D>& jet, double scaled_time) {
  if (jet.size() == 0) return;
  const double t = scaled_time * unit_.time;
  const auto x = jet.y.col(0) * unit_.length;
  if (const double first = x.minCoeff(); first < behind_)
    warn(behind, t, fmt::format("a bead is behind the nozzle, at x = {:.3g} cm", first));
  if constexpr (D == 3) {
    const double r = unit_.length * std::sqrt((jet.y.col(1).square() + jet.y.col(2).square()).maxCoeff());
    if (r > distance_)
      warn(off_axis, t,
           fmt::format("a bead is {:.3g} cm off the axis, farther than the collector is away", r));
  }
  const double v =
      unit_.velocity *
      std::sqrt(jet.y.template middleCols<D>(velocity_column<D>).square().rowwise().sum().maxCoeff());
  if (v > speed_of_sound)
    warn(fast, t, fmt::format("a bead is faster than sound in air, {:.3g} m/s", v / 100));
  if (supply_ > 0 && released_ >= enough_beads && double(released_) > most_draw * supply_ * t)
    warn(drawn, t,
         fmt::format(
             "the jet has drawn {:.2g} times the volume that `nozzle velocity` supplies; `feed flow` with "
             "`flow rate` gives it what a pump does",
             double(released_) / (supply_ * t)));
}

template <int D>
void Plausibility<D>::warn(Finding finding, double t, const std::string& what) {
  if (warned_[finding]) return;
  warned_[finding] = true;
  warn_at(t, what);
}

template class Plausibility<1>;
template class Plausibility<3>;

}  // namespace treejet
