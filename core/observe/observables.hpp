#pragma once
/// The observables: one function of the jet and its window for each key of core/deck/observable_keys.hpp.
/// Values are in the units of that table (CGS, "1" for scaled ones).

#include <functional>
#include <string_view>

#include "core/base/field_error_report.hpp"
#include "core/jet/scales.hpp"
#include "core/observe/window.hpp"

namespace treejet {

struct Timing {
  double interval = 0, elapsed = 0, left = 0;  ///< wall-clock seconds
};

template <int D>
struct View {
  const Jet<D>& jet;   ///< at the time of output: its oldest bead and its youngest, at the least
  std::int64_t beads;  ///< of the whole jet
  double path;  ///< scaled, from the farthest bead to the nozzle in the window's mean, if it is followed
  const Nozzle<D>& nozzle;
  const Window& window;
  const Scales& scales;
  double nozzle_radius, collector_distance;  ///< cm
  double fed = 0, landed = 0;                ///< scaled charge that passed nozzle and collector in the window
  Timing timing = {};
  const FieldErrorReport* force_error = nullptr;  ///< null: exact forces
};

template <int D>
using Observable = std::function<double(const View<D>&)>;

/// The function behind a key of the table.
template <int D>
Observable<D> observable(std::string_view key);

}  // namespace treejet
