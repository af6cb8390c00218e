#include "integrators/simulation.hpp"

#include <fmt/format.h>

#include <chrono>

#include "integrators/choice.hpp"

namespace treejet {

template <int D>
Simulation<D>::Simulation(const Parameters& p, const Scene& scene, const OutputSetting& setting)
    : jet_(scene.jet),
      stepper_(stepper<D>(chosen_scheme(p))),
      control_(step_control(p)),
      outputs_(p, scene.nozzle, scene.collector, setting),
      march_({scene.jet, scene.motion, *stepper_, *control_, scene.nozzle, scene.collector, p.events,
              p.tolerance.value_or(0), outputs_.watchers()}),
      end_(p.final_time / scales(p).time) {}

template <int D>
void Simulation<D>::finish() {
  const auto started = std::chrono::steady_clock::now();
  march_.to(end_);
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

template <int D>
std::string Simulation<D>::summary() const {
  const Effort& e = march_.effort();
  std::string text = fmt::format("done in {:.3g} s: {} beads on the jet, {} inserted, {} arrived\n", seconds_,
                                 jet_.size() + jet_.held, e.placed, e.removed);
  text += fmt::format(
      "{} evaluations of the forces in {} steps ({} rejected, {} made anew for an event), {:.3g} us each\n",
      e.evaluations, e.steps, e.rejected, e.redone, 1e6 * seconds_ / double(e.evaluations));
  for (const auto& line : outputs_.summary()) text += line + "\n";
  return text;
}

template class Simulation<1>;
template class Simulation<3>;

}  // namespace treejet
