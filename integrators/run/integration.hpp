#pragma once
/// An integration: a system of beads marched by the scheme, step control and error norm that the parameters
/// ask for. Program, trial run and harness all step through here; a march is put together nowhere else.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "forces/scene/scene.hpp"
#include "integrators/march/march.hpp"
#include "integrators/run/scheme_registry.hpp"

namespace treejet {

/// What moves, and between which ends; it outlives the integration.
template <int D>
struct System {
  Jet<D>& jet;
  RightHandSide<D>& right_hand_side;
  const Nozzle<D>& nozzle;
  const Collector& collector;
  Decomposition<D>& decomposition = undivided<D>;
  Columns columns = {};  ///< that the scene adds to the state
  Threads threads = {};  ///< that the algebra of long tables is shared out among
};

/// Whole stretches of 4096 rows to each thread.
inline RowSharing rows_shared(Threads threads) {
  return [threads](Eigen::Index rows, const auto& of_stretch) {
    constexpr int stretch = 4096;
    for_each_block(threads, {0, static_cast<int>(rows)}, stretch,
                   [&](Rows some) { of_stretch(some.first, some.size()); });
  };
}

/// One at a time to whichever thread is free.
inline RowSharing tasks_shared(Threads threads) {
  return [threads](Eigen::Index tasks, const auto& of_stretch) {
    for_each_task(threads, static_cast<int>(tasks), [&](int task) { of_stretch(task, 1); });
  };
}

template <int D>
System<D> system(Scene<D>& scene, RightHandSide<D>& right_hand_side) {
  return {scene.jet,     right_hand_side, scene.nozzle, scene.collector, scene.decomposition(),
          scene.columns, scene.threads};
}

template <int D>
System<D> system(Scene<D>& scene) {
  return system(scene, scene.right_hand_side());
}

template <int D>
class Integration {
 public:
  /// `stop_here` is asked between any two steps, `end_in_sight` told once (integrators/march/march.hpp).
  Integration(const Parameters& p, const System<D>& system, std::vector<Observer<D>*> observers = {},
              std::function<bool()> stop_here = {}, std::function<void()> end_in_sight = {})
      : stepper_(stepper<D>(p, system.decomposition)),
        control_(step_control(p)),
        spacing_(p.refinement ? std::make_optional<Spacing<D>>(p, system.columns) : std::nullopt),
        march({.jet = system.jet,
               .motion = system.right_hand_side,
               .stepper = *stepper_,
               .control = *control_,
               .nozzle = system.nozzle,
               .collector = system.collector,
               .events = event_rule(p),
               .norm = ErrorNorm(p, system.columns),
               .endings = Endings<D>(system.columns),
               .observers = std::move(observers),
               .stop_here = std::move(stop_here),
               .decomposition = system.decomposition,
               .spacing = spacing_ ? &*spacing_ : nullptr,
               .end_in_sight = std::move(end_in_sight)}) {
    stepper_->rows_shared = rows_shared(system.threads);
    if (spacing_ && system.jet.id.size() == 0) number_beads(system.jet, system.decomposition);
  }

 private:
  std::unique_ptr<Stepper<D>> stepper_;
  std::unique_ptr<StepControl> control_;
  std::optional<Spacing<D>> spacing_;

 public:
  March<D> march;
};

}  // namespace treejet
