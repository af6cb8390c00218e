#pragma once
/// Explicit Runge-Kutta pairs: a result of order p with an estimate of the error of its partner of order p
/// - 1.
///
/// Stage i is evaluated at t + c_i h on y + h sum_j a_ij k_j; the result is y + h sum b_i k_i, the error
/// estimate h sum (b_i - b*_i) k_i. A tableau lists c, a (row by row), b and b*. For a pair whose last stage
/// is evaluated on the result ("first same as last") that stage carries weight in b* only.

#include <array>
#include <utility>

#include "core/weighted_sum.hpp"
#include "integrators/stepper.hpp"

namespace treejet {

template <int D, class Tableau>
class EmbeddedRungeKutta final : public Stepper<D> {
 public:
  int order() const override { return Tableau::order; }
  int evaluations() const override { return stages - 1; }

  void step(Motion<D>& f, const Jet<D>& jet, const Node<D>& from, double h, Table<D>& next) override {
    evaluate_stages(f, jet, from, h, std::make_integer_sequence<int, stages - 1>());
    add<stages>(&from.y, from.slope, h, next);
    add<stages + 1>(nullptr, from.slope, h, this->error);
  }

 private:
  static constexpr int stages = Tableau::stages;

  template <int... previous>
  void evaluate_stages(Motion<D>& f, const Jet<D>& jet, const Node<D>& from, double h,
                       std::integer_sequence<int, previous...>) {
    (evaluate_stage<previous + 1>(f, jet, from, h), ...);
  }

  template <int i>
  void evaluate_stage(Motion<D>& f, const Jet<D>& jet, const Node<D>& from, double h) {
    add<i>(&from.y, from.slope, h, stage_);
    f(jet, from.t + Tableau::c[i] * h, stage_, k_[i]);
  }

  /// Weight of slope j in stage i; stage number `stages` is the result, the one after it the error.
  static constexpr double weight(int i, int j) {
    return i < stages ? Tableau::a[i - 1][j] : i == stages ? Tableau::b[j] : Tableau::difference[j];
  }

  /// out = y + h times the slopes before stage i, weighted; zero weights left out.
  template <int i>
  void add(const Table<D>* y, const Table<D>& first, double h, Table<D>& out) const {
    constexpr int before = i < stages ? i : stages;
    constexpr auto counts = [](int j) { return weight(i, j) != 0; };
    constexpr auto count = [&] {
      std::size_t n = 0;
      for (int j = 0; j < before; ++j) n += counts(j);
      return n;
    }();
    std::array<double, count> w;
    std::array<const double*, count> k;
    for (std::size_t j = 0, n = 0; n < count; ++j) {
      if (!counts(static_cast<int>(j))) continue;
      w[n] = h * weight(i, static_cast<int>(j));
      k[n++] = j == 0 ? first.data() : k_[j].data();
    }
    out.resize(first.rows(), Eigen::NoChange);
    weighted_sum(y ? y->data() : nullptr, w, k, first.size(), out.data());
  }

  Table<D> stage_;
  std::array<Table<D>, stages> k_;  ///< from the second slope on; the first is that of `from`
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
  static constexpr double b[] = {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84, 0};
  static constexpr double difference[] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                          -17253. / 339200, 22. / 525, -1. / 40};
};

/// Verner, "Explicit Runge-Kutta methods with estimates of the local truncation error", SIAM J. Numer. Anal.
/// 15 (1978) 772: order 6(5), eight stages.
struct Verner6 {
  static constexpr int order = 6, stages = 8;
  static constexpr double c[] = {0, 1. / 6, 4. / 15, 2. / 3, 5. / 6, 1, 1. / 15, 1};
  static constexpr double a[stages - 1][stages - 1] = {
      {1. / 6},
      {4. / 75, 16. / 75},
      {5. / 6, -8. / 3, 5. / 2},
      {-165. / 64, 55. / 6, -425. / 64, 85. / 96},
      {12. / 5, -8, 4015. / 612, -11. / 36, 88. / 255},
      {-8263. / 15000, 124. / 75, -643. / 680, -81. / 250, 2484. / 10625, 0},
      {3501. / 1720, -300. / 43, 297275. / 52632, -319. / 2322, 24068. / 84065, 0, 3850. / 26703}};
  static constexpr double b[] = {3. / 40, 0, 875. / 2244, 23. / 72, 264. / 1955, 0, 125. / 11592, 43. / 616};
  static constexpr double partner[] = {13. / 160, 0, 2375. / 5984, 5. / 16, 12. / 85, 3. / 44, 0, 0};
  static constexpr double difference[] = {
      b[0] - partner[0], 0, b[2] - partner[2], b[3] - partner[3], b[4] - partner[4], -partner[5], b[6], b[7]};
};

}  // namespace treejet
