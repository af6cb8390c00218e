#pragma once
/// A stress law written for one element, over all of a chain.
///
/// Such a law gives the rates of its state, and their derivatives, from strain rate and state: the stress
/// and, if it keeps one, a column of its own. The conformation A of a polymer, its stretch squared along the
/// element and across it, has two components where the stress is one number,
///
///     sigma = f (A_xx - A_rr) / 3 ;
///
/// a law takes sigma itself for one of them, as that is what pulls, and a logarithm for the other, which
/// keeps it positive whatever the step. Scaled: stress by the elastic modulus, which is elongational, three
/// times that of shear, so that small strains give the same stress in every law; time by mu / G.

#include <cmath>
#include <optional>

#include "forces/terms/term.hpp"

namespace treejet {

struct ElementState {
  double stress = 0, column = 0;
};

template <int D, class Law>
class ElementLaw final : public StressLaw<D> {
 public:
  explicit ElementLaw(const Law& law) : law_(law) {}

  std::string_view name() const override { return Law::name; }
  Columns columns() const override {
    if constexpr (keeps_column)
      return {law_.column()};
    else
      return {};
  }
  bool extrapolates() const override { return Law::smooth; }

  void set(const Chain<D>& c, Rows rows, State<D>& slope) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const ElementState rate = law_.rates(c.strain_rate[i], state(c, i));
      slope(i, stress_column<D>) = rate.stress;
      if constexpr (keeps_column) slope(i, own_columns<D>) = rate.column;
    }
  }
  StressDerivative derivative(const Chain<D>& c, int i) const override {
    return law_.derivative(c.strain_rate[i], state(c, i));
  }

 private:
  static constexpr bool keeps_column = requires(const Law& law) { law.column(); };

  static ElementState state(const Chain<D>& c, int i) {
    if constexpr (keeps_column)
      return {c.stress[i], (*c.state)(i, own_columns<D>)};
    else
      return {c.stress[i], 0};
  }

  Law law_;
};

}  // namespace treejet
