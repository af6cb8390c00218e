#pragma once
/// The Coulomb law of JETSPIN from 1.21 on, softened by the radius of the jet: the pair of bead i and bead j,
/// j the one nearer the nozzle, has
///
///     a_i = (Q q_i / m_i) q_j g(r_i - r_j) ,    a_j = - (Q q_j / m_i) q_i g(r_i - r_j) ,
///     g(d) = d / ( |d| (|d| + a_j)^2 ) ,
///
/// a_j the radius of the element above bead j, a_0 for the nozzle and, while beads are inserted, for the
/// youngest and the held bead. The mass under a_j is that of the other bead, a slip of JETSPIN's which is
/// kept for its decks: forces are opposite only where masses are equal. A pair at one place exerts nothing.
///
/// Sums over all pairs, rows shared among ranks and threads; a row has the same bits on any number of them.
/// Scaled. Source: JETSPIN 1.21.

#include "forces/terms/section.hpp"
#include "forces/terms/term.hpp"
#include "parallel/ranks.hpp"

namespace treejet {

template <int D>
class SoftenedCoulomb final : public ForceTerm<D> {
 public:
  SoftenedCoulomb(double Q, const Section& section, bool inserting, const Ranks& ranks = {})
      : Q_(Q), section_(section), inserting_(inserting), ranks_(ranks) {}

  std::string_view name() const override { return "softened Coulomb sum over all pairs"; }
  void prepare(const Chain<D>& c, Rows rows, Threads threads) override;
  void add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const override;

 private:
  void set_radii(const Chain<D>& c);
  void sum(const Chain<D>& c, Rows rows);

  double Q_;
  Section section_;
  bool inserting_;
  Ranks ranks_;
  Eigen::ArrayXd radius_;   ///< of the element above each point
  Eigen::ArrayXd by_mass_;  ///< charge over mass of each bead, 0 of other points
  typename Chain<D>::Points a_;
};

}  // namespace treejet
