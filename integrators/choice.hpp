#pragma once
/// The scheme and the step control that a deck asks for.

#include <memory>
#include <string>

#include "core/parameters.hpp"
#include "integrators/step_control.hpp"
#include "integrators/stepper.hpp"

namespace treejet {

/// Verner's 6(5) pair takes the place of `auto`: at the event rate of the paper's case 3 it needs the fewest
/// evaluations for errors of 1e-4 cm.
Scheme chosen_scheme(const Parameters& p);
const char* name(Scheme scheme);

template <int D>
std::unique_ptr<Stepper<D>> stepper(Scheme scheme);

std::unique_ptr<StepControl> step_control(const Parameters& p);

/// "fixed steps of 1e-08 s, events located", and the like.
std::string steps_description(const Parameters& p);

}  // namespace treejet
