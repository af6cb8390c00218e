#pragma once
/// Linearly implicit scheme for chains whose local terms are stiff: ROS34PW2, a Rosenbrock-W method of order 3
/// with an embedded result of order 2, L-stable.
///
///     (1 - h gamma J) k_i = h f(t + alpha_i h, y + sum_j alpha_ij k_j) + h J sum_j gamma_ij k_j ,      j < i ,
///     next = y + sum b_i k_i ,      error = sum (b_i - b*_i) k_i .
///
/// A W-method keeps its order whatever J is. Here J is the derivative of the local terms (core/local_jacobian.hpp):
/// what makes a chain stiff is in it, while the Coulomb sum, surface tension and the motion of the nozzle are
/// treated as by an explicit scheme. One factorisation of O(n) and four solves a step. In the unknowns U = gamma k no
/// product with J is left:  (1 - h gamma_ii J) U_i = h gamma_ii f - gamma_ii sum_j (gamma^-1)_ij U_j , j < i. Sources: Rang, Angermann, "New Rosenbrock W-methods of order 3 for
/// partial differential algebraic equations of index 1", BIT 45 (2005) 761; Hairer, Wanner, "Solving ODEs II",
/// IV.7.

#include <Eigen/LU>
#include <array>

#include "integrators/chain_solver.hpp"
#include "integrators/stepper.hpp"

namespace treejet {

/// The coefficients of ROS34PW2 as published, and in the unknowns U.
struct Ros34Pw2 {
  static constexpr int order = 3, stages = 4;
  using Square = Eigen::Matrix4d;
  using Weights = Eigen::RowVector4d;

  static constexpr double diagonal = 4.3586652150845900e-01;
  Square alpha{{0, 0, 0, 0},
               {8.7173304301691801e-01, 0, 0, 0},
               {8.4457060015369423e-01, -1.1299064236484185e-01, 0, 0},
               {0, 0, 1, 0}};
  Square gamma{{diagonal, 0, 0, 0},
               {-8.7173304301691801e-01, diagonal, 0, 0},
               {-9.0338057013044082e-01, 5.4180672388095326e-02, diagonal, 0},
               {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01, diagonal}};
  Weights b{2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00, diagonal};
  Weights partner{3.7810903145819369e-01, -9.6042292212423178e-02, 0.5, 2.1793326075422950e-01};

  Eigen::Vector4d abscissa = alpha.rowwise().sum();
  Square to_k = gamma.inverse();  ///< k = to_k U
  Square state = alpha * to_k;    ///< alpha k
  Weights result = b * to_k, difference = (b - partner) * to_k;
};

template <int D>
class Rosenbrock final : public Stepper<D> {
 public:
  int order() const override { return Ros34Pw2::order; }
  int evaluations() const override { return Ros34Pw2::stages - 1; }

  void step(Motion<D>& f, const Jet<D>& jet, const Node<D>& from, double h, Table<D>& next) override {
    const double s = h * Ros34Pw2::diagonal;
    f.differentiate(jet, from.t, from.y, J_);
    solver_.factor(J_, s);
    U_[0] = s * from.slope;
    solver_.solve(U_[0]);
    for (int i = 1; i < Ros34Pw2::stages; ++i) {
      combine(w_.state.row(i), i, stage_);
      stage_ += from.y;
      f(jet, from.t + w_.abscissa[i] * h, stage_, slope_);
      combine(-Ros34Pw2::diagonal * w_.to_k.row(i), i, U_[i]);
      U_[i] += s * slope_;
      solver_.solve(U_[i]);
    }
    combine(w_.result, Ros34Pw2::stages, next);
    next += from.y;
    combine(w_.difference, Ros34Pw2::stages, this->error);
  }

 private:
  /// sum = w_0 U_0 + ... + w_{n-1} U_{n-1}
  void combine(const Ros34Pw2::Weights& w, int n, Table<D>& sum) {
    sum = w[0] * U_[0];
    for (int j = 1; j < n; ++j) sum += w[j] * U_[j];
  }

  Ros34Pw2 w_;
  LocalJacobian<D> J_;
  ChainSolver<D> solver_;
  Table<D> stage_, slope_;
  std::array<Table<D>, Ros34Pw2::stages> U_;
};

}  // namespace treejet
