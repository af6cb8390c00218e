#pragma once
/// The field of a single charge, e = q (r - p) / |r - p|^3, at the first n of some points r. Scaled, without
/// the group Q.

#include "core/chain.hpp"

namespace treejet {

/// Adds it to e.
template <int D>
void add_field_of(double charge, const Vec<D>& p, std::array<const double*, D> r, Eigen::Index n,
                  std::array<double*, D> e);

template <int D>
typename Chain<D>::Points field_of(double charge, const Vec<D>& p, const typename Chain<D>::Points& point,
                                   Eigen::Index n) {
  typename Chain<D>::Points e = Chain<D>::Points::Zero(n, D);
  add_field_of<D>(charge, p, columns<D>(point), n, columns<D>(e));
  return e;
}

}  // namespace treejet
