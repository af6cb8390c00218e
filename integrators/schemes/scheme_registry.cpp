#include "integrators/schemes/scheme_registry.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/jet/scales.hpp"
#include "integrators/schemes/additive.hpp"
#include "integrators/schemes/embedded.hpp"
#include "integrators/schemes/euler.hpp"
#include "integrators/schemes/heun.hpp"
#include "integrators/schemes/runge_kutta4.hpp"

namespace treejet {

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
    case Scheme::kencarp5:
      return "Kennedy-Carpenter 5(4), local terms implicit";
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
    case Scheme::kencarp5:
      return std::make_unique<AdditiveRungeKutta<D, KennedyCarpenter5>>();
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
  constexpr double first = 1e-4;  // of tau; the control finds its pace within a few steps
  return std::make_unique<AdaptiveStep>(first, chosen_scheme(p) == Scheme::verner6 ? 6 : 5);
}

std::string steps_description(const Parameters& p) {
  const char* events = p.events == EventRule::located ? "events located" : "events seen at step ends";
  if (p.timestep) return fmt::format("fixed steps of {:g} s, {}", *p.timestep, events);
  const std::string reason = choice_reason(p);
  return fmt::format("steps by tolerance {:g}, {}{}{}", *p.tolerance, events, reason.empty() ? "" : "; ",
                     reason);
}

}  // namespace treejet
