/// Observables where the answer is known: a straight jet that moves uniformly, and windows of any length.

#include <catch2/catch.hpp>

#include "core/deck/observable_keys.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

/// No force at all: two beads, 0.3 and 0.6 cm from the nozzle, move on at 7 cm/s to a collector at 1 cm.
Parameters uniform_motion() {
  Parameters p = example("single-bead");
  p.density_charge = 0;
  p.nozzle_velocity = 7;
  p.initial_length = 0.6;
  p.points = 2;
  p.collector_distance = 1;
  p.removing = true;
  return with_steps(p, Scheme::rk4, 3.3e-4);  // steps that do not divide the windows
}

constexpr double round_off = 1e-11;

}  // namespace

TEMPLATE_TEST_CASE_SIG("A jet in uniform motion shows its position, path and arrival exactly", "",
                       ((int D), D), 1, 3) {
  Run<D> run(uniform_motion());
  const double window = 0.01;
  const auto r = recorded<D>(
      run, {"t", "x", "lp", "rlp", "vc", "svc", "rc", "rrr", "vx", "n", "f", "l", "angl"}, window, 0.08);
  REQUIRE(r.size() == 9);
  const double arrival = (1 - 0.6) / 7;  // 0.0571 s, in window 6; the second bead would arrive at 0.1 s
  for (std::size_t k = 0; k < r.size(); ++k) {
    const double t = 0.01 * double(k);
    CAPTURE(t);
    CHECK(r[k][0] == Approx(t).epsilon(round_off));
    CHECK(r[k][1] == Approx((t < arrival ? 0.6 : 0.3) + 7 * t).epsilon(round_off));
    // the path is straight: its mean over the window is x at the middle, but for the window of the removal
    if (k == 0) CHECK(r[k][2] == Approx(0.6).epsilon(round_off));
    if (k > 0 && k != 6)
      CHECK(r[k][2] == Approx((t < arrival ? 0.6 : 0.3) + 7 * (t - 0.005)).epsilon(round_off));
    if (k == 6) {
      const double before = arrival - 0.05, after = 0.06 - arrival;
      const double path =
          before * (0.6 + 7 * (0.05 + before / 2)) + after * (0.3 + 7 * (arrival + after / 2));
      CHECK(r[k][2] == Approx(path / 0.01).epsilon(round_off));
    }
    CHECK(r[k][3] == Approx(r[k][2] / 1).epsilon(round_off));  // collector distance 1 cm
    CHECK(r[k][4] == Approx(k == 6 ? 7 : 0).margin(1e-10));
    CHECK(r[k][5] == Approx(0).margin(1e-9));
    CHECK(r[k][6] ==
          Approx(k == 6 ? 0.015 : 0).epsilon(round_off));  // spacing unchanged: radius at the nozzle
    CHECK(r[k][7] == Approx(k == 6 ? 1 : 0).epsilon(round_off));
    CHECK(r[k][8] == Approx(7).epsilon(round_off));
    CHECK(r[k][9] == (t < arrival ? 2 : 1));
    CHECK(r[k][10] == (t < arrival ? 0 : 1));
    CHECK(r[k][11] == 2);
    CHECK(r[k][12] == 0);
  }
}

TEST_CASE(
    "What arrives is reported with its strain rate, its speed and the radius of its stretched element") {
  // beads 0.45 apart at x = H, 9 and 6 cm/s, set up by hand shortly before the first one arrives
  Parameters p = uniform_motion();
  Run<3> run(p);
  const double L = run.unit.length, U = run.unit.velocity;
  run.scene.jet.y.row(0) << (1 - 9e-5) / L, 0, 0, 9 / U, 0, 0, 0;
  run.scene.jet.y.row(1) << (0.55 - 6e-5) / L, 0, 0, 6 / U, 0, 0, 0;
  const auto r = recorded<3>(run, {"vc", "svc", "rc"}, 1e-4, 1e-4);
  REQUIRE(r.size() == 2);
  REQUIRE(run.jet().removed == 1);
  // in the 1e-5 s to the arrival the strain, 6.7/s * 1e-5 s, makes a stress of 0.7, which slows the bead down
  // by stress / (density * length) = 1.8 cm/s^2: 2e-5 cm/s
  CHECK(r[1][0] == Approx(9).margin(2e-5));
  CHECK(r[1][1] == Approx((9 - 6) / 0.45).margin(4e-5 / 0.45 + 1e-4));  // and the length by 3 cm/s * 1e-5 s
  // volume: a^2 l = a_0^2 l_step, with l_step 0.3 cm
  CHECK(r[1][2] * r[1][2] * 0.45 == Approx(0.015 * 0.015 * 0.3).epsilon(1e-6));
}

TEST_CASE("The path of a jet is the polygon through its beads to the circling nozzle") {
  Parameters p = example("pvp");
  Run<3> run(p);
  const auto r = recorded<3>(run, {"lp"}, 0.01, 1e-9);
  // at the start one bead on the axis at 0.02 cm and the nozzle at (0, 1e-3, 0)
  CHECK(r[0][0] == Approx(std::hypot(0.02, 1e-3)).epsilon(1e-14));
}

TEST_CASE("Every key of the documented table has an observable in both dimensions") {
  for (const auto& known : observable_keys) {
    CHECK(observable<1>(known.key) != nullptr);
    CHECK(observable<3>(known.key) != nullptr);
  }
  CHECK_THROWS(observable<1>("velocity"));
}

TEST_CASE("Rows stand at exactly the asked times, whatever the steps") {
  Run<1> run(with_steps(example("single-bead"), Scheme::heun, 7e-5));
  const auto r = recorded<1>(run, {"t"}, 1e-3, 0.05);
  REQUIRE(r.size() == 51);
  for (std::size_t k = 0; k < r.size(); ++k) CHECK(r[k][0] == Approx(1e-3 * double(k)).epsilon(1e-14));
}
