#pragma once
/// The observables: one function of the jet and its window for each key of core/observable_keys.hpp.
/// Values are in the units of that table (CGS, "1" for scaled ones).

#include <functional>
#include <string_view>

#include "core/force_error.hpp"
#include "core/scales.hpp"
#include "core/statistics.hpp"

namespace treejet {

struct Timing {
  double interval = 0, elapsed = 0, left = 0;  ///< wall-clock seconds
};

template <int D>
struct View {
  const Jet<D>& jet;  ///< at the time of output
  const Nozzle<D>& nozzle;
  const Window& window;
  const Scales& scales;
  double nozzle_radius, collector_distance;  ///< cm
  double fed = 0, landed = 0;                ///< scaled charge that passed nozzle and collector in the window
  Timing timing = {};
  const ForceError* force_error = nullptr;  ///< null: exact forces
};

template <int D>
using Observable = std::function<double(const View<D>&)>;

/// The function behind a key of the table.
template <int D>
Observable<D> observable(std::string_view key);

}  // namespace treejet
