/// The recipe "a force term" of docs/recipes.md.

#include <catch2/catch.hpp>

#include <cmath>

#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// Drag of still air, m dv/dt = - c |v| v: a force that knows the velocity.
class QuadraticDrag final : public ForceTerm<3> {
 public:
  explicit QuadraticDrag(double c) : c_(c) {}

  std::string_view name() const override { return "quadratic drag"; }

  void add(const Chain<3>& chain, Rows rows, Acceleration<3>& a) const override {
    for (int i = rows.first; i < rows.last; ++i) {
      const Vec<3> v = chain.velocity(i);
      a.row(i) -= c_ * chain.inverse_mass[i] * v.norm() * v.transpose().array();
    }
  }

  /// d(|v| v)/dv = |v| 1 + v v^T / |v|, for the schemes that solve for local terms.
  void differentiate(const Chain<3>& chain, LocalJacobian<3>& J) const override {
    auto& by_velocity = J.by_velocity();
    for (int i = 0; i < chain.beads; ++i) {
      const Vec<3> v = chain.velocity(i);
      const double speed = v.norm();
      if (speed > 0)
        by_velocity[std::size_t(i)] -=
            c_ * chain.inverse_mass[i] * (speed * Eigen::Matrix3d::Identity() + v * v.transpose() / speed);
    }
  }

 private:
  double c_;
};

}  // namespace

TEST_CASE("A bead in still air slows down as 1/t") {
  const double c = 0.5, m = 2, t = 3;
  const Vec<3> r(1, 2, 3), v(0.6, 0, -0.8);
  auto f = equations<3>(plain_parameters(), QuadraticDrag(c));
  auto jet = jet_of<3>({{r, v, 0, m}});
  march_to<3>(t, 0.01, jet, f, plain_parameters(), Scheme::rk4);
  // |v0| = 1: v = v0 / (1 + c t / m), r = r0 + v0 (m / c) log(1 + c t / m); h^4 c^4 / 120 a step is 1e-12
  const Vec<3> slower = v / (1 + c * t / m), further = r + v * (m / c) * std::log(1 + c * t / m);
  CHECK((velocity<3>(jet.y, 0) - slower).norm() < 1e-10);
  CHECK((position<3>(jet.y, 0) - further).norm() < 1e-10);
}

TEST_CASE("The derivative of drag by the velocity is that of its differences") {
  auto f = equations<3>(plain_parameters(), QuadraticDrag(0.5));
  auto jet = jet_of<3>({{Vec<3>(1, 2, 3), Vec<3>(0.6, 0.1, -0.8), 0, 2}});
  LocalJacobian<3> J;
  f.differentiate(jet, 0, jet.y, J);
  const double h = 1e-4;
  for (int k = 0; k < 3; ++k) {
    auto more = jet, less = jet;
    more.y(0, velocity_column<3> + k) += h;
    less.y(0, velocity_column<3> + k) -= h;
    const Eigen::Array<double, 1, 3> difference =
        (slope(f, more) - slope(f, less)).row(0).segment<3>(velocity_column<3>) / (2 * h);
    // central differences err by h^2 / 6 times a third derivative of order 1
    CHECK((J.acceleration_by_v[0].col(k).transpose().array() - difference).abs().maxCoeff() < 1e-8);
  }
}
