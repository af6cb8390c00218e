#pragma once
/// A scene: what a deck's parameters compose, ready to move. Only the terms that the deck names are in it,
/// and those that a caller brings along; for each one left out, `left_out` tells why.

#include <string>
#include <vector>

#include "core/base/field_error_report.hpp"
#include "core/jet/collector.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/parameters.hpp"
#include "forces/multirate/multirate_motion.hpp"
#include "forces/terms/equations_of_motion.hpp"

namespace treejet {

struct Composed {
  std::string term, reason;
};

/// Physics of a caller's own: it stands behind the terms of the deck, and multirate, subdomains, checkpoints
/// and frames treat it as they treat these.
template <int D>
struct OwnTerms {
  std::vector<std::unique_ptr<ForceTerm<D>>> forces;
  std::vector<std::unique_ptr<ColumnRate<D>>>
      columns;  ///< names are those of files: small letters, digits, _
};

template <int D>
struct Scene {
  Jet<D> jet;  ///< the initial jet
  Nozzle<D> nozzle;
  Collector collector;
  std::unique_ptr<EquationsOfMotion<D>> motion = {};
  std::unique_ptr<MultirateMotion<D>> multirate = {};  ///< null where every term is evaluated at every stage
  /// Of a jet held in subdomains: who holds what, and its motion. Null where every rank holds all of it.
  std::unique_ptr<Decomposition<D>> subdomains = {};
  std::unique_ptr<RightHandSide<D>> distributed_motion = {};
  const FieldErrorReport* distributed_error = nullptr;
  Columns columns;  ///< added to the state
  std::vector<Composed> composed = {}, left_out = {};
  Threads threads = {};

  /// The right-hand side to step with.
  RightHandSide<D>& right_hand_side() {
    if (multirate) return *multirate;
    if (distributed_motion) return *distributed_motion;
    return *motion;
  }

  /// What is measured of approximate forces, null where all are exact.
  const FieldErrorReport* force_error() const {
    return motion->coulomb() ? motion->coulomb()->error() : distributed_error;
  }

  Decomposition<D>& decomposition() { return subdomains ? *subdomains : undivided<D>; }
};

template <int D>
Scene<D> compose(const Parameters& parameters, Threads threads, const Ranks& ranks = {},
                 OwnTerms<D> own = {});

}  // namespace treejet
