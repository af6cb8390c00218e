#pragma once
/// A bead as the numbers that it is sent as: state, mass, charge, volume, id if beads have one, which is
/// exact as a floating-point number up to 2^53.

#include "core/jet/jet.hpp"
#include "parallel/rows.hpp"

namespace treejet {

/// A column a bead.
using Beads = Eigen::ArrayXXd;

/// What is constant of a bead, and travels with it.
inline constexpr auto bead_constants = {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume};

/// Also of a jet that has no bead here.
inline bool has_ids(const Jet<3>& jet) {
  return jet.born > 0;
}

inline Eigen::Index words_of_bead(const Jet<3>& jet) {
  return jet.y.cols() + Eigen::Index{bead_constants.size()} + (has_ids(jet) ? 1 : 0);
}

/// Beads of some rows, with the state that they have in `y`.
inline Beads packed(const Jet<3>& jet, const State<3>& y, Rows rows) {
  const Eigen::Index first = rows.first, n = rows.size();
  Beads beads(words_of_bead(jet), n);
  Eigen::Index word = y.cols();
  beads.topRows(word) = y.middleRows(first, n).transpose();
  for (auto each : bead_constants) beads.row(word++) = (jet.*each).segment(first, n).transpose();
  if (has_ids(jet)) beads.row(word) = jet.id.segment(first, n).cast<double>().transpose();
  return beads;
}

/// Into rows that the jet has, from `first` on.
inline void unpack(const Eigen::Ref<const Beads>& beads, Jet<3>& jet, Eigen::Index first) {
  const Eigen::Index n = beads.cols();
  Eigen::Index word = jet.y.cols();
  jet.y.middleRows(first, n) = beads.topRows(word).transpose();
  for (auto each : bead_constants) (jet.*each).segment(first, n) = beads.row(word++).transpose();
  if (has_ids(jet)) jet.id.segment(first, n) = beads.row(word).transpose().cast<std::int64_t>();
}

/// Copies rows of one jet into rows that another has.
inline void copy_beads(const Jet<3>& from, const State<3>& y, Rows rows, Jet<3>& to, Eigen::Index first) {
  const Eigen::Index at = rows.first, n = rows.size();
  to.y.middleRows(first, n) = y.middleRows(at, n);
  for (auto each : bead_constants) (to.*each).segment(first, n) = (from.*each).segment(at, n);
  if (has_ids(to)) to.id.segment(first, n) = from.id.segment(at, n);
}

/// Gives the jet so many rows, whose contents are left open; in tables that stay if it has as many.
inline void set_rows(Jet<3>& jet, Eigen::Index rows, Eigen::Index columns) {
  jet.y.resize(rows, columns);
  for (auto each : bead_constants) (jet.*each).resize(rows);
  jet.id.resize(has_ids(jet) ? rows : 0);
}

}  // namespace treejet
