/// Curvature of three points and the surface tension made of it.

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "forces/terms/surface_tension.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

using Exact = Eigen::Matrix<long double, 3, 1>;

/// The same vector by the textbook's circumcentre, (|u|^2 s - |s|^2 u) x n / (2 |n|^2) with n = u x s, in
/// long double.
Exact circumcircle(const Exact& u, const Exact& s) {
  const Exact n = u.cross(s);
  const Exact centre = (u.squaredNorm() * s.cross(n) + s.squaredNorm() * n.cross(u)) / (2 * n.squaredNorm());
  return centre / centre.squaredNorm();
}

/// The curvature vector of the circle through the origin, u and s.
Vec<3> through(const Vec<3>& u, const Vec<3>& s) {
  const Vec<3> U = u / u.squaredNorm(), S = s / s.squaredNorm();
  const Triple k = curvature({U[0], U[1], U[2]}, {S[0], S[1], S[2]});
  return {k[0], k[1], k[2]};
}

}  // namespace

TEST_CASE("Beads on a circle have curvature 1/R towards its centre, however far apart") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    // an orthonormal pair spans the plane of a circle of radius R around `centre`
    const Vec<3> e = Vec<3>(normal(random), normal(random), normal(random)).normalized();
    const Vec<3> f = e.cross(Vec<3>(normal(random), normal(random), normal(random))).normalized();
    const double R = std::exp(normal(random)), back = 0.02 + 0.5 * std::abs(normal(random)), ahead = 0.4;
    const auto at = [&](double phi) { return Vec<3>(R * (std::cos(phi) * e + std::sin(phi) * f)); };
    const Vec<3> r = at(0), k = through(at(-back) - r, at(ahead) - r);
    // differences of coordinates of size R carry 1e-16 R; a sagitta of R back ahead / 2 divides them
    const double round_off = 1e-15 / (back * ahead);
    CHECK(k.norm() * R == Approx(1).epsilon(round_off));
    CHECK((k * R + r / R).norm() < round_off);
  }
}

TEST_CASE("Nearly collinear beads have a curvature good to the round-off of their coordinates") {
  // down to an angle of 1e-12, where JETSPIN's construction returns noise of size 1/l
  for (double angle : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    CAPTURE(angle);
    const Vec<3> u(1, angle, -angle / 3), s(-0.7, 0.2 * angle, angle / 5);
    const Exact exact = circumcircle(u.cast<long double>(), s.cast<long double>());
    const Vec<3> k = through(u, s);
    // the vector is the small difference of O(1) terms: absolute round-off of a few 1e-16, whatever its size
    CHECK((k.cast<long double>() - exact).norm() < 2e-15);
    // along the bead's normal it keeps its relative precision, there the terms themselves are small
    CHECK(k[1] == Approx(double(exact[1])).epsilon(1e-13));
    CHECK(k[2] == Approx(double(exact[2])).epsilon(1e-13));
  }
}

TEST_CASE("A straight jet feels no surface tension, whatever its direction and spacing") {
  const Parameters p = plain_parameters();
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> gap(0.01, 3);
  for (const Vec<3>& way : {Vec<3>(1, 0, 0), Vec<3>(1, 2, -2), Vec<3>(0.3, 1e-7, 0.9)}) {
    std::vector<Bead<3>> beads(30);
    double distance = 0, closest = 3;
    for (std::size_t i = beads.size(); i-- > 0;) {
      const double g = gap(random);
      distance += g;
      closest = std::min(closest, g);
      beads[i].position = distance * way.normalized();
    }
    auto f = equations<3>(p, SurfaceTension(1, 1));
    const State<3> dy = slope(f, jet_of<3>(beads));
    // positions of size 50 carry 50 * 1e-16 of round-off, seen over gaps g twice: curvature, and 1/l of the
    // section
    const double round_off = 2 * distance * 2.3e-16 / std::pow(closest, 3);
    CHECK(dy.middleCols<3>(3).abs().maxCoeff() < round_off);
  }
}

TEST_CASE("A bead just released on the chord of its neighbours feels no surface tension") {
  Parameters p = plain_parameters();
  p.inserting = true;
  const Nozzle<3> nozzle(p);
  auto jet = jet_of<3>({{Vec<3>(2.9, 0.8, -0.3)}, {2 * Vec<3>(3, 1, -1).normalized()}});
  nozzle.place(jet);
  nozzle.release(jet);
  auto f = equations<3>(p, SurfaceTension(1, 1));
  CHECK(slope(f, jet).row(2).segment<3>(3).abs().maxCoeff() < 1e-15);
  CHECK(slope(f, jet).row(1).segment<3>(3).abs().maxCoeff() > 1e-3);
}

TEST_CASE(
    "On a ring of beads surface tension points to the centre with the formula's size, the free end "
    "excepted") {
  const Parameters p = plain_parameters();
  const double R = 2, step = 0.1, L_step = 1.3, A = 0.7;
  // the last point of the ring is the nozzle, at the origin
  const Vec<3> centre(R, 0, 0);
  std::vector<Bead<3>> beads;
  for (int i = 12; i >= 1; --i)
    beads.push_back({centre + R * Vec<3>(-std::cos(i * step), std::sin(i * step), 0), Vec<3>::Zero(), 0, 2});
  auto f = equations<3>(p, SurfaceTension(L_step, A));
  const State<3> dy = slope(f, jet_of<3>(beads));
  const double l = 2 * R * std::sin(step / 2);
  const double expected = L_step * A / 2 / R / l;  // mass 2; (1/4) (2 / sqrt l)^2 = 1 / l
  CHECK(dy.row(0).segment<3>(3).abs().maxCoeff() == 0);
  for (int i = 1; i < 12; ++i) {
    const Vec<3> a = velocity<3>(dy, i), inward = (centre - beads[std::size_t(i)].position) / R;
    CHECK((a - expected * inward).norm() < 1e-13 * expected / step);  // round-off over the sagitta
  }
}
