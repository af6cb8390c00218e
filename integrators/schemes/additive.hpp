#pragma once
/// Additive Runge-Kutta pairs for chains whose local terms are stiff: those terms are solved for, everything
/// else is treated as by an explicit pair.
///
/// Within a step the slope is split into a linear part, J the local Jacobian at its beginning
/// (core/jet/local_jacobian.hpp), and the rest:   f(t, y) = J (y - y_n) + rest(t, y) .   The linear part goes
/// by the implicit tableau, diagonal gamma, the rest by the explicit one, with the same weights b:
///
///     (1 - h gamma J) Z_i = h sum_j ( explicit_ij rest_j + implicit_ij J Z_j ) ,      j < i ,
///     rest_i = f(t + c_i h, y_n + Z_i) - J Z_i ,
///     next = y_n + h sum b_i f_i ,      (1 - h gamma J) error = h sum (b_i - b*_i) f_i .
///
/// The last solve takes from the estimate what relaxes within the step: of that the difference of the two
/// solutions says nothing about the error (Shampine; Hairer, Wanner, "Solving ODEs II", IV.8). One
/// factorisation and as many solves of O(n) a step as there are stages, no iteration. The order holds
/// whatever J is, so that what is not stiff may be left out of it: the Coulomb sum, surface tension, the
/// motion of the nozzle. The last row of the implicit tableau is b, hence
///
///     next = y_n + Z_s + h sum (b_i - explicit_si) rest_i ,
///
/// in which the stiff part comes through the solution Z_s only.

#include <array>

#include "integrators/schemes/chain_solver.hpp"
#include "integrators/schemes/stepper.hpp"

namespace treejet {

template <int D, class Tableau>
class AdditiveRungeKutta final : public Stepper<D> {
 public:
  int order() const override { return Tableau::order; }
  int evaluations() const override { return Tableau::stages - 1; }

  void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    constexpr int last = Tableau::stages - 1;
    const double s = h * Tableau::diagonal;
    f.differentiate(jet, from.t, from.y, J_);
    solver_.factor(J_, s);
    rest_[0] = from.slope;
    linear_[0].setZero(from.y.rows(), from.y.cols());
    for (int i = 1; i <= last; ++i) {
      sum_known_stages(i, h);
      Z_ = known_;
      solver_.solve(Z_);
      this->set(linear_[i], (Z_ - known_) / s);
      this->set(next, from.y + Z_);
      f(jet, from.t + Tableau::c[i] * h, next, rest_[i]);
      this->set(rest_[i], rest_[i] - linear_[i]);
    }
    conclude(h, next);
    solver_.solve(this->error);
  }

 private:
  /// h sum_j ( explicit_ij rest_j + implicit_ij J Z_j )
  void sum_known_stages(int i, double h) {
    known_.resize(linear_[0].rows(), linear_[0].cols());
    this->share(known_.rows(), [&](const auto& rows) {
      auto&& known = rows(known_);
      known.setZero();
      for (int j = 0; j < i; ++j)
        known += h * (Tableau::explicit_part[i][j] * rows(rest_[j]) +
                      Tableau::implicit_part[i][j] * rows(linear_[j]));
    });
  }

  /// From the last stage to `next`, and the two solutions' difference.
  void conclude(double h, State<D>& next) {
    constexpr int last = Tableau::stages - 1;
    this->error.resize(next.rows(), next.cols());
    this->share(next.rows(), [&](const auto& rows) {
      auto &&end = rows(next), &&error = rows(this->error);
      error.setZero();
      for (int i = 0; i <= last; ++i) {
        end += h * (Tableau::b[i] - Tableau::explicit_part[last][i]) * rows(rest_[i]);
        error += h * (Tableau::b[i] - Tableau::partner[i]) * (rows(rest_[i]) + rows(linear_[i]));
      }
    });
  }

  LocalJacobian<D> J_;
  ChainSolver<D> solver_;
  State<D> known_, Z_;
  std::array<State<D>, Tableau::stages> rest_, linear_;  ///< linear_[i] = J Z_i
};

/// Kennedy and Carpenter, "Higher-order additive Runge-Kutta schemes for ordinary differential equations",
/// Appl. Numer. Math. 136 (2019) 183: order 5(4), eight stages, implicit part L-stable and of stage order 2.
/// Their fractions, rounded.
struct KennedyCarpenter5 {
  static constexpr int order = 5, stages = 8;
  static constexpr double diagonal = 2. / 9;
  // clang-format off
  static constexpr double c[] = {0, 0.44444444444444442, 0.75871412497179891, 0.11526943456404197, 0.3567571284043185,
       0.71999999999999997, 0.95499999999999996, 1};
  static constexpr double explicit_part[stages][stages] = {
      {0},
      {0.44444444444444442},
      {0.1111111111111111, 0.64760301386068775},
      {0.091829866647747907, 0.035448567517799241, -0.012008999601505184},
      {-0.34252354516023137, -0.26767785943050182, 0.11056894178117282, 0.85638959121387881},
      {-0.0097722828790043955, 0.21070865398661751, 0.075924120912175361, 0.20765518596381696,
       0.23548432201639455},
      {0.46686370681500694, 1.2903598800650855, 0.37840596884419414, -0.56345584032826157,
       -0.2883238346202236, -0.32884988077580141},
      {0.61439671625166914, 0.61439671625166914, 0.31747780106686158, -0.71215206239529361,
       0.11498708015310211, 0.09139031575415682, -0.040496567082165244}};
  static constexpr double implicit_part[stages][stages] = {
      {0},
      {0.22222222222222221, 0.22222222222222221},
      {0.26824595137478835, 0.26824595137478835, 0.22222222222222221},
      {-0.057945592237231995, -0.057945592237231995, 0.0089383968162837328, 0.22222222222222221},
      {-0.043305287723547685, -0.043305287723547685, -0.034013891077568637, 0.25515937270676026,
       0.22222222222222221},
      {0.13179599023759678, 0.13179599023759678, -0.032376726277862332, 0.12385474427672251,
       0.14270777930372408, 0.22222222222222221},
      {0.30932282100434261, 0.30932282100434261, -0.68291992723367922, -0.058822756149695461,
       -0.041308613833499437, 0.89718343298596659, 0.22222222222222221},
      {0, 0, 0.17366253573581261, 0.25479166260812353, 0.24190176845094791, 0.30740485830222825,
       -0.19998304731933453, 0.22222222222222221}};
  static constexpr double b[] = {0, 0, 0.17366253573581261, 0.25479166260812353, 0.24190176845094791, 0.30740485830222825,
       -0.19998304731933453, 0.22222222222222221};
  static constexpr double partner[] = {0, 0, 0.062724216952707135, 0.25523315714677963, 0.23902754916001318, 0.39907952207535802,
       -0.14315725125850667, 0.18709280592364871};
  // clang-format on
};

}  // namespace treejet
