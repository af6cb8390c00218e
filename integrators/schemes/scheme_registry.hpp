#pragma once
/// The scheme and the step control that a deck asks for.

#include <memory>
#include <string>

#include "core/jet/parameters.hpp"
#include "core/jet/stiffness.hpp"
#include "integrators/march/step_control.hpp"
#include "integrators/schemes/stepper.hpp"

namespace treejet {

const char* name(Scheme scheme);

template <int D>
std::unique_ptr<Stepper<D>> stepper(Scheme scheme);

std::unique_ptr<StepControl> step_control(const Parameters& p);

/// "fixed steps of 1e-08 s, events located", and the like, and why the scheme if the deck leaves that open.
std::string steps_description(const Parameters& p);

}  // namespace treejet
