#include "integrators/run/scheme_registry.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/jet/scales.hpp"
#include "integrators/schemes/additive.hpp"
#include "integrators/schemes/embedded.hpp"
#include "integrators/schemes/euler.hpp"
#include "integrators/schemes/heun.hpp"
#include "integrators/schemes/runge_kutta4.hpp"
#include "integrators/schemes/sra1.hpp"

namespace treejet {

namespace {

template <int D>
using Maker = std::unique_ptr<Stepper<D>> (*)();

template <int D, class S>
std::unique_ptr<Stepper<D>> make() {
  return std::make_unique<S>();
}

template <int D>
std::unique_ptr<Stepper<D>> without_noise() {
  return std::make_unique<Sra1<D>>(Noise{}, wiener_path(1));
}

template <int D>
constexpr std::pair<Scheme, Maker<D>> makers[] = {
    {Scheme::euler, make<D, Euler<D>>},
    {Scheme::heun, make<D, Heun<D>>},
    {Scheme::rk4, make<D, RungeKutta4<D>>},
    {Scheme::sra1, without_noise<D>},
    {Scheme::dopri5, make<D, EmbeddedRungeKutta<D, DormandPrince5>>},
    {Scheme::verner6, make<D, EmbeddedRungeKutta<D, Verner6>>},
    {Scheme::kencarp5, make<D, AdditiveRungeKutta<D, KennedyCarpenter5>>},
};

}  // namespace

template <int D>
std::unique_ptr<Stepper<D>> stepper(Scheme scheme) {
  for (const auto& [of, maker] : makers<D>)
    if (of == scheme) return maker();
  throw std::logic_error("no scheme chosen");
}

template <int D>
std::unique_ptr<Stepper<D>> stepper(const Parameters& p, const Decomposition<D>& all) {
  const Scheme scheme = chosen_scheme(p);
  if (scheme == Scheme::sra1 && is_random(p))
    return std::make_unique<Sra1<D>>(noise(p), wiener_path(p.seed), all);
  return stepper<D>(scheme);
}

template std::unique_ptr<Stepper<1>> stepper<1>(Scheme);
template std::unique_ptr<Stepper<3>> stepper<3>(Scheme);
template std::unique_ptr<Stepper<1>> stepper<1>(const Parameters&, const Decomposition<1>&);
template std::unique_ptr<Stepper<3>> stepper<3>(const Parameters&, const Decomposition<3>&);

std::unique_ptr<StepControl> step_control(const Parameters& p) {
  const double time = scales(p).time;
  if (p.timestep) return std::make_unique<FixedStep>(*p.timestep / time);
  constexpr double first = 1e-4;  // of tau; the control finds its pace within a few steps
  const SchemeProperties& scheme = properties(chosen_scheme(p));
  return std::make_unique<AdaptiveStep>(first, scheme.order,
                                        most_samples_of_a_step * shortest_interval(p) / time, scheme.share);
}

std::string steps_description(const Parameters& p) {
  const char* events = event_rule(p) == EventRule::located ? "events located" : "events seen at step ends";
  if (p.timestep) return fmt::format("fixed steps of {:g} s, {}", *p.timestep, events);
  const std::string reason = choice_reason(p);
  return fmt::format("steps by tolerance {:g}, {}{}{}", *p.tolerance, events, reason.empty() ? "" : "; ",
                     reason);
}

}  // namespace treejet
