#pragma once
/// What makes the schemes of core/jet/schemes.hpp, and the step control and words that go with a deck's.

#include <memory>
#include <string>

#include "core/jet/decomposition.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/schemes.hpp"
#include "core/jet/stiffness.hpp"
#include "integrators/march/step_control.hpp"
#include "integrators/schemes/stepper.hpp"

namespace treejet {

/// std::logic_error for `automatic`, which is no scheme before one is chosen. The stochastic scheme is one
/// without noise.
template <int D>
std::unique_ptr<Stepper<D>> stepper(Scheme scheme);

/// The deck's, with its noise, for a jet that is held like this.
template <int D>
std::unique_ptr<Stepper<D>> stepper(const Parameters& p, const Decomposition<D>& all = undivided<D>);

std::unique_ptr<StepControl> step_control(const Parameters& p);

/// "fixed steps of 1e-08 s, events located", and the like, and why the scheme if the deck leaves that open.
std::string steps_description(const Parameters& p);

}  // namespace treejet
