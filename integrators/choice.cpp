#include "integrators/choice.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/scales.hpp"
#include "integrators/embedded.hpp"
#include "integrators/euler.hpp"
#include "integrators/heun.hpp"
#include "integrators/rosenbrock.hpp"
#include "integrators/runge_kutta4.hpp"

namespace treejet {

Scheme chosen_scheme(const Parameters& p) {
  return p.integrator == Scheme::automatic ? Scheme::verner6 : p.integrator;
}

const char* name(Scheme scheme) {
  switch (scheme) {
    case Scheme::automatic:
      return "auto";
    case Scheme::euler:
      return "Euler";
    case Scheme::heun:
      return "Heun";
    case Scheme::rk4:
      return "Runge-Kutta 4";
    case Scheme::dopri5:
      return "Dormand-Prince 5(4)";
    case Scheme::verner6:
      return "Verner 6(5)";
    case Scheme::ros34pw2:
      return "Rosenbrock-W 3(2), local terms implicit";
  }
  return "";
}

template <int D>
std::unique_ptr<Stepper<D>> stepper(Scheme scheme) {
  switch (scheme) {
    case Scheme::euler:
      return std::make_unique<Euler<D>>();
    case Scheme::heun:
      return std::make_unique<Heun<D>>();
    case Scheme::rk4:
      return std::make_unique<RungeKutta4<D>>();
    case Scheme::dopri5:
      return std::make_unique<EmbeddedRungeKutta<D, DormandPrince5>>();
    case Scheme::verner6:
      return std::make_unique<EmbeddedRungeKutta<D, Verner6>>();
    case Scheme::ros34pw2:
      return std::make_unique<Rosenbrock<D>>();
    case Scheme::automatic:
      break;
  }
  throw std::logic_error("no scheme chosen");
}

template std::unique_ptr<Stepper<1>> stepper<1>(Scheme);
template std::unique_ptr<Stepper<3>> stepper<3>(Scheme);

std::unique_ptr<StepControl> step_control(const Parameters& p) {
  const double time = scales(p).time;
  if (p.timestep) return std::make_unique<FixedStep>(*p.timestep / time);
  // the control finds its pace within a few steps, whatever the first one
  const Scheme scheme = chosen_scheme(p);
  const int order = scheme == Scheme::ros34pw2 ? 3 : scheme == Scheme::dopri5 ? 5 : 6;
  return std::make_unique<AdaptiveStep>(1e-6 * p.final_time / time, order);
}

std::string steps_description(const Parameters& p) {
  const char* events = p.events == EventRule::located ? "events located" : "events seen at step ends";
  if (p.timestep) return fmt::format("fixed steps of {:g} s, {}", *p.timestep, events);
  return fmt::format("steps by tolerance {:g}, {}", *p.tolerance, events);
}

}  // namespace treejet
