/// One force at a time, where Newton's equation can be solved on paper.

#include <catch2/catch.hpp>

#include "forces/terms/external_field.hpp"
#include "forces/terms/gravity.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {
constexpr Scheme second_order_and_up[] = {Scheme::heun, Scheme::rk4, Scheme::dopri5, Scheme::verner6};

/// Of 20 steps of 0.1. Verner's coefficients reach 207, his weights 176: a stage is off by 1e-16 * 207 h, the
/// result by 176 h times that, 4e-14 a step.
double round_off(Scheme scheme) {
  return scheme == Scheme::verner6 ? 8e-13 : 1e-14;
}
}  // namespace

TEST_CASE("A bead under gravity alone falls along a parabola") {
  const Parameters p = plain_parameters();
  for (Scheme scheme : second_order_and_up) {
    CAPTURE(name(scheme));
    auto f = equations<3>(p, Gravity<3>(0.8));
    auto jet = jet_of<3>({{Vec<3>(1, 2, 3), Vec<3>(0.5, -0.25, 0.125)}});
    march_to<3>(2, 0.1, jet, f, p, scheme);
    // a parabola is integrated without truncation error from order 2 on: 20 steps of round-off remain
    CHECK(jet.y(0, 0) == Approx(1 + 0.5 * 2 + 0.8 * 2 * 2 / 2).epsilon(round_off(scheme)));
    CHECK(jet.y(0, 1) == Approx(2 - 0.25 * 2).epsilon(round_off(scheme)));
    CHECK(jet.y(0, 2) == Approx(3 + 0.125 * 2).epsilon(round_off(scheme)));
    CHECK(jet.y(0, 3) == Approx(0.5 + 0.8 * 2).epsilon(round_off(scheme)));
  }
}

TEST_CASE("In the external field alone a bead accelerates by its charge over its mass") {
  const Parameters p = plain_parameters();
  for (Scheme scheme : second_order_and_up) {
    CAPTURE(name(scheme));
    auto f = equations<1>(p, ElectricField<1>(1.5));
    auto jet = jet_of<1>({{Vec<1>(4), Vec<1>(0), 0, /*mass*/ 2, /*charge*/ 3},
                          {Vec<1>(1), Vec<1>(0), 0, /*mass*/ 5, /*charge*/ 1}});
    march_to<1>(2, 0.1, jet, f, p, scheme);
    CHECK(jet.y(0, 0) == Approx(4 + 1.5 * 3 / 2 * 2).epsilon(round_off(scheme)));  // as for gravity
    CHECK(jet.y(1, 0) == Approx(1 + 1.5 * 1 / 5 * 2).epsilon(round_off(scheme)));
  }
}

TEST_CASE("Without charge the deck's field and Coulomb forces are gone and a thin fluid falls freely") {
  Parameters p = example("single-bead");
  p.density_charge = 0;
  p.gravity = true;
  p.viscosity = p.elastic_modulus = 1e-9;  // relaxation time 1 s, as good as no stress
  p.final_time = 0.1;
  const auto check = [&](auto run) {
    run.to(0.1);
    // the stress stays below G = 1e-9 times the strain rate times 1 s, some 50; over the weight of the bead's
    // section, rho g l_step = 256, that is less than 1e-9 of g
    CHECK(run.x() == Approx(0.319 + 980.665 * 0.01 / 2).epsilon(1e-9));
  };
  check(Run<1>(with_tolerance(p, 1e-12)));
  p.system = 3;
  check(Run<3>(with_tolerance(p, 1e-12)));
}

TEST_CASE("Without any force a bead moves on at the nozzle's velocity, and its element carries no stress") {
  Parameters p = example("single-bead");
  p.density_charge = 0;
  p.nozzle_velocity = 7;
  p.initial_length = 0.3;
  Run<3> run(with_tolerance(p, 1e-6));
  run.to(0.05);
  CHECK(run.x() == Approx(0.3 + 7 * 0.05).epsilon(1e-12));  // round-off of the steps
  CHECK(run.jet().y(0, stress_column<3>) == 0);
}
