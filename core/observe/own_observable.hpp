#pragma once
/// An observable of a caller's own: a column behind those that a deck asks for in its tables, and an element
/// of traj.h5 beside its observables.

#include <functional>
#include <string>
#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

template <int D>
struct OwnObservable {
  std::string key;   ///< small letters, digits, _; none of core/deck/observable_keys.hpp
  std::string unit;  ///< of the value, as files show it
  std::function<double(const Jet<D>&)> value;  ///< of the jet, which is scaled, at the time of output
};

template <int D>
using OwnObservables = std::vector<OwnObservable<D>>;

}  // namespace treejet
