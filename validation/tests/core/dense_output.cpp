/// The solution between the ends of a step (core/jet/dense_output.hpp).

#include <catch2/catch.hpp>
#include <cmath>

#include "core/jet/dense_output.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// A helix with a swelling stress: x = exp(t), y = sin 2t, z = cos 2t, sigma = sin 3t.
SolutionPoint<3> helix(double t) {
  SolutionPoint<3> node{t, State<3>(1, 7), State<3>(1, 7)};
  const double e = std::exp(t), s = std::sin(2 * t), c = std::cos(2 * t);
  node.y << e, s, c, e, 2 * c, -2 * s, std::sin(3 * t);
  node.slope << e, 2 * c, -2 * s, e, -4 * s, -4 * c, 3 * std::cos(3 * t);
  return node;
}

struct Errors {
  std::vector<double> position, velocity, stress;
};

/// Errors at the fraction theta of steps from t = 0.3, each half as long as the one before.
Errors errors_at(double theta) {
  Errors e;
  for (double h : {0.4, 0.2, 0.1, 0.05}) {
    const SolutionPoint<3> a = helix(0.3), b = helix(0.3 + h);
    const double t = 0.3 + theta * h;
    const Eigen::Array<double, 1, 7> difference = (DenseOutput<3>(a, b).at(t) - helix(t).y).abs();
    e.position.push_back(difference.head<3>().maxCoeff());
    e.velocity.push_back(difference.segment<3>(3).maxCoeff());
    e.stress.push_back(difference[6]);
  }
  return e;
}

}  // namespace

TEST_CASE("Dense output has the orders 6, 5 and 4 in position, velocity and stress, also a little outside") {
  for (double theta : {-0.01, 0.2, 0.7, 1.01}) {
    CAPTURE(theta);
    const Errors e = errors_at(theta);
    // the next term of the error is a step h = 0.05 to 0.4 smaller: up to 0.3 in the order
    CHECK(orders(e.stress).back() == Approx(4).margin(0.3));
    if (theta > 0 && theta < 1) {  // outside, position and velocity reach round-off
      CHECK(orders(e.position).back() == Approx(6).margin(0.3));
      CHECK(orders(e.velocity).back() == Approx(5).margin(0.3));
    }
  }
}

TEST_CASE(
    "Near an end the dense output errs with the cube, the square and the square of the distance to it") {
  for (bool late : {false, true}) {
    Errors e;
    for (double delta : {0.02, 0.01}) {
      const Errors now = errors_at(late ? 1 - delta : delta);
      e.position.push_back(now.position.front());
      e.velocity.push_back(now.velocity.front());
      e.stress.push_back(now.stress.front());
    }
    // (1 - theta) and the next term change the power by a few hundredths
    CHECK(orders(e.position).back() == Approx(3).margin(0.15));
    CHECK(orders(e.velocity).back() == Approx(2).margin(0.15));
    CHECK(orders(e.stress).back() == Approx(2).margin(0.15));
  }
}

TEST_CASE("A parabola of fifth degree with a cubic stress is met exactly") {
  const auto node = [](double t) {
    SolutionPoint<1> n{t, State<1>(1, 3), State<1>(1, 3)};
    n.y << std::pow(t, 5) - t * t, 5 * std::pow(t, 4) - 2 * t, t * t * t;
    n.slope << n.y(0, 1), 20 * t * t * t - 2, 3 * t * t;
    return n;
  };
  const SolutionPoint<1> a = node(0.5), b = node(1.25);
  const DenseOutput<1> segment(a, b);
  for (double t : {0.5, 0.6, 0.9, 1.2, 1.25})
    for (int k : {0, 1, 2}) CHECK(segment.at(t)(0, k) == Approx(node(t).y(0, k)).margin(1e-14));  // round-off
  CHECK(segment.jerk_at_end(0)[0] == Approx(60 * 1.25 * 1.25).epsilon(1e-12));
}

TEST_CASE("The dense output of some beads is that of the whole table") {
  SolutionPoint<1> a{0, State<1>::Random(5, 3), State<1>::Random(5, 3)};
  SolutionPoint<1> b{0.5, State<1>::Random(5, 3), State<1>::Random(5, 3)};
  const DenseOutput<1> segment(a, b);
  State<1> two(2, 3);
  segment.at(0.2, 3, two);
  CHECK((two == segment.at(0.2).bottomRows(2)).all());
}
