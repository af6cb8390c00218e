#pragma once
/// The equations of motion at two rates: beads near the two ends of the jet are fast, the others slow.
///
/// Over a few steps the field of far beads and the whole slope of slow beads change smoothly, so both are
/// continued in time by the parabola through their last three full evaluations (history.hpp). Computed are
///
///   - of a fast bead: its local terms and the field of the points near to its end of the chain; the
///     continued field of the rest is added;
///   - of a slow bead: the field of the held bead, whose charge rises too fast to be continued; its continued
///     acceleration and stress rate are added.
///
/// A step follows the fast beads and those near to them. The others move, between its ends, as a parabola of
/// the acceleration lets them, which Simpson's rule integrates exactly,
///
///     v(h) = v + h/6 (a_0 + 4 a_m + a_1) ,    r(h) = r + h v + h^2/6 (a_0 + 2 a_m) ,
///
/// a_m at the middle of the step; for what the held bead does to them, the square of which is left out, the
/// rule is of fourth order.
///
/// A full evaluation is made at an accepted point of the solution once the interval since the last one is
/// over. There the continued values meet the true ones: their difference times the interval, in the norm of
/// the step control, is the error of the method, of fourth order in the interval, and sets the next interval.
/// So beads that come close in space, though far along the chain, shorten the interval. No step is longer
/// than the interval: what it continues ends less than two of them after the last full evaluation. Source:
/// multiple time stepping.

#include "core/jet/error_norm.hpp"
#include "forces/multirate/history.hpp"
#include "forces/multirate/short_waves.hpp"
#include "forces/terms/equations_of_motion.hpp"

namespace treejet {

template <int D>
class MultirateMotion final : public RightHandSide<D> {
 public:
  /// The norm is that of the step control; the error of the continuation is held to a part of what it
  /// permits.
  /// With `refines` elements may be split and merged.
  MultirateMotion(EquationsOfMotion<D>& full, const ErrorNorm& norm, const ShortWaves& short_waves,
                  bool refines = false)
      : MultirateMotion(full, full, norm, short_waves, undivided<D>, refines) {}
  /// Of a jet in subdomains, whose rows here include those of the fast region, these from `local` terms, and
  /// all from time to time from `full`.
  MultirateMotion(EquationsOfMotion<D>& local, FullMotion<D>& full, const ErrorNorm& norm,
                  const ShortWaves& short_waves, const Decomposition<D>& all, bool refines = false)
      : local_(local), full_(full), norm_(norm), short_waves_(short_waves), all_(all), refines_(refines) {}

  /// For the tables of all beads, or of those that `followed` gave.
  void operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) override;
  bool on_accepted_step(const Jet<D>& jet, double t, const State<D>& y, const State<D>* known,
                        State<D>& slope) override;
  double smooth_from(double t) override {
    history_.forget();
    return full_.smooth_from(t);
  }
  double longest_step() const override {
    return history_.continuable(history_.beads()) ? interval_ : RightHandSide<D>::longest_step();
  }
  const FastRegion<D>* fast_region(const Jet<D>& jet) override;
  void complete(const Jet<D>& jet, double h, const State<D>& some, State<D>& next) override;
  void before_removal(const Jet<D>& jet) override { history_.before_removal(jet, Q()); }
  void after_release(const Jet<D>& jet) override { history_.after_release(jet, Q(), all_); }
  std::vector<Jet<D>> past(const Jet<D>& jet) override { return history_.past(jet); }
  std::int64_t after_refinement(const Jet<D>& jet, std::vector<Jet<D>> past) override {
    const int evaluations = history_.after_refinement(jet, std::move(past), full_);
    full_evaluations_ += evaluations;
    return evaluations;
  }

  void visit(Archive& state) override {
    state(full_, interval_, full_evaluations_, amplifies_);
    all_.in_subdomains() ? history_.visit_all_but_beads(state) : state(history_);
  }
  /// What goes with the beads of a jet in subdomains.
  Eigen::ArrayXXd of_beads(Eigen::Index first, Eigen::Index rows) const {
    return history_.of_beads(first, rows);
  }
  void set_beads(const Eigen::ArrayXXd& table) { history_.set_beads(table); }

  std::int64_t full_evaluations() const { return full_evaluations_; }

 private:
  using Points = typename Chain<D>::Points;
  using Weights = typename History<D>::Weights;

  double Q() const { return full_.Q(); }
  Eigen::ArrayXd specific_charge(const Jet<D>& jet, Rows rows) const;
  void follow(const Jet<D>& jet, const State<D>& y);
  void name_fast_beads(const Jet<D>& jet);
  void continued(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope);
  void continue_middle(const Jet<D>& jet, double t, const State<D>& y, const State<D>& ends,
                       State<D>& slope) const;
  void continued_ends(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope);
  Vec<D> coulomb_on_held(const Weights& w);
  void set_near_beads(const Weights& w, const State<D>& y, State<D>& slope) const;
  void accelerate(Rows rows, State<D>& slope) const;
  void drift(const SolutionPoint<D>& from, double h, Rows middle, State<D>& all) const;
  void push_by_held(const Jet<D>& jet, double h, Rows middle, State<D>& all) const;
  double mismatch(const Jet<D>& jet, double t, const State<D>& y, const PastEvaluation<D>& now) const;
  bool amplifies();
  double aim() const;

  EquationsOfMotion<D>& local_;
  FullMotion<D>& full_;
  ErrorNorm norm_;
  ShortWaves short_waves_;
  const Decomposition<D>& all_;
  bool refines_;
  History<D> history_;
  double interval_ = 0;  ///< from a moment to the next node that is one, and the longest step
  std::int64_t full_evaluations_ = 0;
  bool amplifies_ = false;  ///< the jet its short waves, so that nothing is continued

  FastRegion<D> fast_region_{{}, fast_region_old};
  const Eigen::ArrayXd* volumes_ = nullptr;  ///< of all elements
  Census census_;                            ///< of the jet
  Eigen::ArrayXd specific_charge_;           ///< Q q / m of the followed beads
  Chain<D> chain_;                           ///< of these
  Points field_;                             ///< of this stage
};

}  // namespace treejet
