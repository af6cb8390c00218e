/// Stress of an element: relaxation, steady extension, and the signs of the Herschel-Bulkley law.

#include <catch2/catch.hpp>
#include <cmath>

#include "validation/support/prescribed.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// d sigma/dt of one element of stress `stress` drawn out at `strain_rate`.
double stress_rate(const StressLaw<1>& law, double strain_rate, double stress) {
  Chain<1> c;
  c.beads = 1;
  c.strain_rate.setConstant(2, strain_rate);
  c.stress.setConstant(2, stress);
  State<1> slope(2);
  law.set(c, {0, 1}, slope);
  return slope(0, stress_column<1>);
}

}  // namespace

TEST_CASE("At fixed length the Maxwell stress relaxes as exp(-t)") {
  const Parameters p = plain_parameters();
  auto f = equations<1>(p);
  auto jet = jet_of<1>({bead_at(3, 0, 2.5), bead_at(2, 0, -1), bead_at(1, 0, 0.5)});
  march_to<1>(1.5, 0.01, jet, f, p, Scheme::verner6);
  for (int i : {0, 1, 2}) {
    const double initial[] = {2.5, -1, 0.5};
    // order 6: h^6/7! per unit time is below round-off
    CHECK(jet.y(i, stress_column<1>) == Approx(initial[i] * std::exp(-1.5)).epsilon(1e-13));
    CHECK(jet.y(i, 0) == 3 - i);
  }
}

TEST_CASE("In steady extension the stress of every element goes to viscosity times strain rate") {
  const Parameters p = plain_parameters();
  const double rate = 0.4;
  auto f = equations<3>(p, HomogeneousExtension<3>(rate));
  const Vec<3> way = Vec<3>(2, -1, 2) / 3;  // any direction
  std::vector<Bead<3>> beads;
  for (int i = 4; i >= 1; --i) beads.push_back({i * way, rate * i * way});
  auto jet = jet_of<3>(beads);
  march_to<3>(1, 0.01, jet, f, p, Scheme::verner6);
  for (int i = 0; i < 4; ++i) {
    CHECK(jet.y(i, stress_column<3>) == Approx(rate * (1 - std::exp(-1.0))).epsilon(1e-12));
    CHECK(position<3>(jet.y, i).norm() == Approx((4 - i) * std::exp(rate)).epsilon(1e-12));
  }
  march_to<3>(40, 0.1, jet, f, p, Scheme::verner6);
  // 1 - exp(-40) is 1; the law alone damps what the larger steps add
  for (int i = 0; i < 4; ++i) CHECK(jet.y(i, stress_column<3>) == Approx(rate).epsilon(1e-9));
}

TEST_CASE("Herschel-Bulkley with index 1, consistency 1 and no yield stress is Maxwell's law") {
  const HerschelBulkley<1> law(0, 1, 1, 0.01);
  for (double rate : {-3.0, -0.2, 0.0, 0.7, 40.0})
    CHECK(stress_rate(law, rate, 0.3) == Approx(stress_rate(Maxwell<1>(), rate, 0.3)).epsilon(1e-15));
}

TEST_CASE("An element that shortens gets the opposite stress of one that stretches, and a finite one") {
  const double small = 1e-3;
  for (double index : {0.3, 0.7, 1.0, 2.0}) {
    const HerschelBulkley<1> law(0.5, 1.7, index, small);
    for (double rate : {1e-12, 1e-3, 0.1, 1.0, 25.0}) {
      CAPTURE(index, rate);
      const double exact = 0.5 + 1.7 * std::pow(rate, index), rounded = small / rate * small / rate;
      const double found = stress_rate(law, rate, 0);
      CHECK(stress_rate(law, -rate, 0) == -found);
      // sqrt(1 + x) is within x / 2 of 1, and so is its power -1 to 1; below r_0 it goes to 0 as r does
      if (rate > small) CHECK(found == Approx(exact).epsilon(rounded));
      if (rate < small) CHECK(found < 1.01 * (0.5 + 1.7 * std::pow(small, index)) * rate / small);
    }
    CHECK(stress_rate(law, 0, 0.25) == -0.25);  // at rest nothing yields: the stress relaxes
  }
}

TEST_CASE("A deck's consistency is scaled to units of the viscosity with strain rates per second") {
  Parameters p = example("single-bead");
  p.hbfluid = true;
  p.hb_consistency = 3;
  p.hb_index = 0.5;
  p.yield_stress = 2000;
  p.small_strain_rate = 1;
  const auto scene = compose<1>(p, {1});
  // stress k mu rate^nu at 100/s, over G; tau = 0.01 s makes the scaled rate 1
  const double expected = (2000 + 3 * 100 * std::pow(100, 0.5)) / 10000;
  CHECK(stress_rate(scene.motion->stress_law(), 1, 0) == Approx(expected).epsilon(1e-4));  // (r_0 / r)^2
}

TEST_CASE("A yield stress without hbfluid adds to a Newtonian dashpot") {
  Parameters p = example("single-bead");
  p.yield_stress = 5000;
  p.small_strain_rate = 1;
  const auto scene = compose<1>(p, {1});
  CHECK(stress_rate(scene.motion->stress_law(), 2, 0.25) ==
        Approx(0.5 + 2 - 0.25).epsilon(1e-5));  // r_0 = r / 200
}
