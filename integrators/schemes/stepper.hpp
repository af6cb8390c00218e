#pragma once
/// A one-step scheme for dy/dt = f(t, y): whole-table algebra in which no bead, force, thread or rank is
/// visible. What it sets by `set` is shared out by rows as the run says.
///
/// `from` holds state and slope at the beginning, so the first stage is never computed twice. `next` is
/// resized. A scheme with an embedded partner leaves in `error` the difference of the two results, else
/// `error` is empty.

#include "core/base/row_sharing.hpp"
#include "core/jet/dense_output.hpp"
#include "core/jet/right_hand_side.hpp"

namespace treejet {

template <int D>
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual int order() const = 0;
  virtual int evaluations() const = 0;  ///< of f, a step, beside the slope that `from` brings
  virtual void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
                    State<D>& next) = 0;
  /// The slope at `next`, of a scheme that needs it for its error estimate.
  virtual const State<D>* slope_at_end() const { return nullptr; }

  State<D> error;
  RowSharing rows_shared = all_at_once;

 protected:
  /// out = value, an expression of tables of one shape.
  template <class Expression>
  void set(State<D>& out, const Expression& value) const {
    out.resize(value.rows(), value.cols());
    share(value.rows(), [&](const auto& rows) { rows(out) = rows(value); });
  }

  /// Calls f(rows) for stretches of tables of n rows, maybe at the same time: rows(table) are those of one.
  template <class OfStretch>
  void share(Eigen::Index n, const OfStretch& f) const {
    for_each_stretch(rows_shared, n, [&](Eigen::Index first, Eigen::Index count) {
      if (count == n)
        f([](auto& table) -> auto& { return table; });
      else
        f([=](auto& table) { return table.middleRows(first, count); });
    });
  }
};

}  // namespace treejet
