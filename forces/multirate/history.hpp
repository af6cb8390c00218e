#pragma once
/// What is remembered of the last full evaluations, and its continuation in time: the parabola through three
/// of them.
///
/// Remembered is the motion without a held bead, whose charge rises too fast to be continued. At a removal
/// and a release the values are repaired as if the bead had always been absent or present; the past of a
/// released bead is the straight way on which it left. For a refinement of the elements the states are
/// remembered too, led to the refined jet as it goes on, and evaluated anew as if the elements had always
/// been the new ones. Rows are those of the jet: of one in subdomains, all fast beads and some of the others.
/// Scaled. Source: e.g. Hairer, Norsett, Wanner, "Solving ODEs I", III.1.

#include <array>
#include <vector>

#include "core/jet/chain.hpp"
#include "core/jet/decomposition.hpp"
#include "forces/terms/full_motion.hpp"
#include "parallel/rows.hpp"

namespace treejet {

/// Fast beads at the two ends of the jet, and how many points next to them act on them by a field that is not
/// continued. Fewer young ones would make the step wait for the slow ones; more do not lengthen it.
constexpr int fast_old = 4, fast_young = 24, near_points = 8;
/// Both ends with what is near to them: beads that a step at two rates follows, and those of the old end.
constexpr int fast_region_old = fast_old + near_points,
              fast_region_beads = fast_region_old + near_points + fast_young;

/// A fast end of a chain, and the points near to it.
struct FastEnd {
  Rows fast, window;
};
std::array<FastEnd, 2> fast_ends(int beads, int points);

/// A full evaluation, remembered.
template <int D>
struct PastEvaluation {
  using Points = typename Chain<D>::Points;
  double t = 0;
  Points point;  ///< beads, nozzle
  Eigen::ArrayXd point_charge;
  Points field;           ///< E at the beads, of all points
  Points far;             ///< E at the fast beads, of the points that are not near
  Eigen::ArrayXXd slope;  ///< acceleration, stress rate, rates of the added columns
  State<D> state;         ///< of the beads; no rows in a scene that does not refine its elements

  PastEvaluation() = default;
  /// That of the chain at t; the field is what its charges make at its beads.
  PastEvaluation(double t, const Chain<D>& chain, const Jet<D>& jet, const Points& field,
                 const State<D>& slope, double Q);

  /// What the fast beads feel of far points, from all else.
  void set_far();

  void visit(Archive& state) { state(t, point, point_charge, field, far, slope, this->state); }
};

/// Field at the fast beads of an end, of the points near to it.
template <int D>
void set_near_field(const typename Chain<D>::Points& point, const Eigen::ArrayXd& charge, const FastEnd& end,
                    typename Chain<D>::Points& field);

template <int D>
class History {
 public:
  static constexpr int count = 3;
  using Weights = std::array<double, count>;

  /// Whether the parabola, which needs three moments, may be used: it pays only where there are as many beads
  /// as a step follows.
  bool continuable(Eigen::Index beads) const;

  /// Columns of the slopes.
  int columns() const { return static_cast<int>(past_[0].slope.cols()); }
  /// Beads that are remembered.
  int beads() const { return static_cast<int>(past_[0].slope.rows()); }
  /// From the last moment to t; infinite without one.
  double since(double t) const;

  /// The weights of the remembered values at t.
  Weights weights(double t) const;
  /// Rows of what the parabola gives for a table of the moments.
  template <class Array>
  auto continuation(const Weights& w, Array PastEvaluation<D>::*table, Rows rows) const {
    const auto remembered = [&](int k) { return (past_[k].*table).middleRows(rows.first, rows.size()); };
    return w[0] * remembered(0) + w[1] * remembered(1) + w[2] * remembered(2);
  }
  /// The rows from `first` on of a column of the slopes, moment by moment.
  std::array<const double*, count> slopes(int column, int first) const;

  /// Where the parabola may be used already, `now` comes with its far field. False if it has taken the place
  /// of the last moment, which was too near in time.
  bool remember(PastEvaluation<D>&& now);
  void forget() { *this = {}; }
  void before_removal(const Jet<D>& jet, double Q);
  void after_release(const Jet<D>& jet, double Q, const Decomposition<D>& all = undivided<D>);
  /// The jets of the past, to be refined as the jet is; none, and what was not enough for a parabola is
  /// forgotten.
  std::vector<Jet<D>> past(const Jet<D>& jet);
  /// Evaluates the same anew for them. Returns the evaluations.
  int after_refinement(const Jet<D>& jet, std::vector<Jet<D>> past, FullMotion<D>& full);

  /// FileError if what is read cannot be of one jet.
  void visit(Archive& state);

  /// What is remembered of the beads of some rows, a row each, and of all rows anew; and what is no bead's.
  Eigen::ArrayXXd of_beads(Eigen::Index first, Eigen::Index rows) const;
  void set_beads(const Eigen::ArrayXXd& table);
  void visit_all_but_beads(Archive& state);

 private:
  using Points = typename Chain<D>::Points;

  Eigen::Index words_of_bead() const;
  static void lead_to(double t, State<D> slope, std::vector<Jet<D>>& past);

  std::array<PastEvaluation<D>, count> past_;  ///< newest first
  int remembered_ = 0;
  bool with_states_ = false;
};

}  // namespace treejet
