#pragma once
/// Physics that a program of somebody else's adds to that of a deck: forces, columns of the state,
/// observables. Multirate, subdomains, checkpoints and outputs treat forces and columns as they treat what is
/// ours; observables need `parallel replicated`, as they see the whole jet. All files of such a run give the
/// version as `0.1.0 with physics of its own: NAME`, and only the same program resumes it.

#include <functional>
#include <string>

#include "core/observe/own_observable.hpp"
#include "forces/scene/scene.hpp"

namespace treejet {

struct OwnPhysics {
  std::string name;  ///< empty: stock physics
  /// Made anew for each scene, in its scaled units (core/jet/scales.hpp).
  std::function<OwnTerms<3>(const Parameters&)> terms = [](const Parameters&) { return OwnTerms<3>(); };
  OwnObservables<3> observables = {};
};

/// The terms for a scene of D dimensions. InputError for a straight jet: they are written for three.
template <int D>
OwnTerms<D> own_terms(const OwnPhysics& own, const Parameters& p);

template <int D>
OwnObservables<D> own_observables(const OwnPhysics& own);

}  // namespace treejet
