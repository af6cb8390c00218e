#pragma once
/// What a deck or a command line says of the Coulomb sum, as the solver's request.

#include "core/jet/parameters.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"

namespace treejet {

inline CoulombRequest coulomb_request(const CoulombSetting& choice, bool points_move) {
  CoulombRequest request;
  request.points_move = points_move;
  request.method = choice.coulomb == CoulombSum::direct ? CoulombMethod::direct
                   : choice.coulomb == CoulombSum::tree ? CoulombMethod::tree
                                                        : CoulombMethod::automatic;
  request.accuracy = choice.coulomb_accuracy;
  request.order = choice.coulomb_order;
  request.opening = choice.coulomb_opening;
  request.leaf = choice.coulomb_leaf;
  if (choice.coulomb_tree != TreeOrder::automatic) request.space = choice.coulomb_tree == TreeOrder::space;
  request.local_expansions = choice.coulomb_expansions == ExpansionKind::local;
  return request;
}

}  // namespace treejet
