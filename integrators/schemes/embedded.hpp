#pragma once
/// Explicit Runge-Kutta pairs: a result of order p with an estimate of the error of its partner of order p
/// - 1.
///
/// Stage i is evaluated at t + c_i h on y + h sum_j a_ij k_j; the result is y + h sum b_i k_i, the error
/// estimate h sum (b_i - b*_i) k_i. A tableau lists c, a (row by row), b and b - b*. Both pairs here evaluate
/// their last stage on the result ("first same as last"): it is the first of the next step, its weights a are
/// b, and it carries weight in b* only.

#include <array>
#include <utility>

#include "core/base/weighted_sum.hpp"
#include "integrators/schemes/stepper.hpp"

namespace treejet {

template <int D, class Tableau>
class EmbeddedRungeKutta final : public Stepper<D> {
 public:
  int order() const override { return Tableau::order; }
  int evaluations() const override { return stages - 1; }

  void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    evaluate_stages(f, jet, from, h, std::make_integer_sequence<int, stages - 2>());
    add<stages - 1>(&from.y, from.slope, h, next);
    f(jet, from.t + h, next, k_[stages - 1]);
    add<stages>(nullptr, from.slope, h, this->error);
  }
  const State<D>* slope_at_end() const override { return &k_[stages - 1]; }

 private:
  static constexpr int stages = Tableau::stages;

  template <int... previous>
  void evaluate_stages(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
                       std::integer_sequence<int, previous...>) {
    (evaluate_stage<previous + 1>(f, jet, from, h), ...);
  }

  template <int i>
  void evaluate_stage(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h) {
    add<i>(&from.y, from.slope, h, stage_);
    f(jet, from.t + Tableau::c[i] * h, stage_, k_[i]);
  }

  /// Weight of slope j in stage i; the last stage is the result, the one after it the error.
  static constexpr double weight(int i, int j) {
    return i < stages ? Tableau::a[i - 1][j] : Tableau::difference[j];
  }

  /// out = y + h times the slopes before stage i, weighted; zero weights left out.
  template <int i>
  void add(const State<D>* y, const State<D>& first, double h, State<D>& out) const {
    constexpr auto counts = [](int j) { return weight(i, j) != 0; };
    constexpr auto count = [&] {
      std::size_t n = 0;
      for (int j = 0; j < i; ++j) n += counts(j);
      return n;
    }();
    std::array<double, count> w;
    std::array<const double*, count> k;
    for (std::size_t j = 0, n = 0; n < count; ++j) {
      if (!counts(static_cast<int>(j))) continue;
      w[n] = h * weight(i, static_cast<int>(j));
      k[n++] = j == 0 ? first.data() : k_[j].data();
    }
    out.resize(first.rows(), first.cols());
    const auto numbers = [&](Eigen::Index begin, Eigen::Index n) {  // of a table, column after column
      std::array<const double*, count> from = k;
      for (const double*& slope : from) slope += begin;
      weighted_sum(y ? y->data() + begin : nullptr, w, from, n, out.data() + begin);
    };
    for_each_stretch(this->rows_shared, first.rows(), [&](Eigen::Index row, Eigen::Index rows) {
      if (rows == first.rows()) return numbers(0, first.size());
      for (Eigen::Index column = 0; column < first.cols(); ++column)
        numbers(column * first.rows() + row, rows);
    });
  }

  State<D> stage_;
  std::array<State<D>, stages> k_;  ///< from the second slope on; the first is that of `from`
};

/// Dormand and Prince, "A family of embedded Runge-Kutta formulae", J. Comput. Appl. Math. 6 (1980) 19: order
/// 5(4).
struct DormandPrince5 {
  static constexpr int order = 5, stages = 7;
  static constexpr double c[] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
  static constexpr double a[stages - 1][stages - 1] = {
      {1. / 5},
      {3. / 40, 9. / 40},
      {44. / 45, -56. / 15, 32. / 9},
      {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
      {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
      {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
  static constexpr double difference[] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                          -17253. / 339200, 22. / 525, -1. / 40};
};

/// Verner, "Numerically optimal Runge-Kutta pairs with interpolants", Numer. Algorithms 53 (2010) 383: order
/// 6(5), nine stages, the pair that he calls efficient: its error is small because stages lie close together,
/// which makes round-off some 1e4 h^2 times greater. His fractions, rounded.
struct Verner6 {
  static constexpr int order = 6, stages = 9;
  static constexpr double c[] = {
      0, 3. / 50, 1439. / 15000, 1439. / 10000, 4973. / 10000, 389. / 400, 1999. / 2000, 1, 1};
  // clang-format off
  static constexpr double a[stages - 1][stages - 1] = {
      {3. / 50},
      {519479. / 27000000, 2070721. / 27000000},
      {1439. / 40000, 0, 4317. / 40000},
      {1.3186834152331484, 0, -5.042058063628562, 4.220674648395414},
      {-41.87259166432751, 0, 159.43256216313748, -122.11921356501004, 5.531743066200053},
      {-54.430156935316504, 0, 207.06725136501848, -158.61081378459, 6.991816585950242, -0.01859723106220323},
      {-54.66374178728198, 0, 207.95280625538936, -159.2889574744995, 7.018743740796944, -0.018338785905045722,
       -0.0005119484997882099},
      {0.03438957868357036, 0, 0, 0.25826245556335037, 0.4209371189673537, 4.40539646966931, -176.48311902429865,
       172.36413340141507}};
  static constexpr double difference[] = {0.008623404282200854, 0, 0, -0.019434029953152708, 0.028450072588037983,
       -2.1097110610652914, 103.45854289996397, -101.39980461914912, 1. / 30};
  // clang-format on
};

}  // namespace treejet
