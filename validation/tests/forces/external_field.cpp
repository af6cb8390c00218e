/// The external field in time and place: waves, rotation, needle and plate, both polarities.

#include <catch2/catch.hpp>
#include <cmath>

#include "forces/terms/external_field.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

using std::numbers::pi;

/// A deck's wave, the relaxation time and so the unit of time being 1 s.
Parameters wave(Wave kind, double frequency = 1, double time = 1, double phase = 0) {
  Parameters p = plain_parameters();
  p.field_wave = kind;
  p.field_frequency = frequency;
  p.field_time = time;
  p.field_phase = phase;
  return p;
}

/// Velocity along x of a bead of charge over mass 1 in a field of this wave, from rest.
double speed_after(double t, const Parameters& p, Scheme scheme, double dt = 0.07) {
  auto f = equations<1>(p, ElectricField<1>({1, 0, 0}, Waveform(p)));
  auto jet = jet_of<1>({bead_at(10)});
  march_to<1>(t, dt, jet, f, p, scheme);
  return jet.y(0, 1);
}

constexpr Scheme schemes_of_fixed_steps[] = {Scheme::euler, Scheme::heun, Scheme::rk4, Scheme::kencarp5};

}  // namespace

TEST_CASE("A square wave drives a bead half of the time, exactly, whatever the scheme and its step") {
  for (const Scheme scheme : schemes_of_fixed_steps) {
    CAPTURE(name(scheme));
    // steps end where the wave jumps: what is left is round-off of a hundred steps
    CHECK(speed_after(4, wave(Wave::square, 2.5), scheme) == Approx(4 / 2.0).epsilon(1e-13));
    // begun a quarter of a period late, on for a quarter at once
    CHECK(speed_after(0.1, wave(Wave::square, 2.5, 1, pi / 2), scheme) == Approx(0.1).epsilon(1e-13));
    CHECK(speed_after(0.2, wave(Wave::square, 2.5, 1, pi / 2), scheme) == Approx(0.1).epsilon(1e-13));
  }
}

TEST_CASE("Ramp and table drive a bead by the area below their lines") {
  Parameters p = wave(Wave::table);
  p.field_table = {0.5, 1, 1.5, -3, 2, 0};
  for (const Scheme scheme :
       {Scheme::heun, Scheme::rk4, Scheme::kencarp5}) {  // of order 2 and more: exact on lines
    CAPTURE(name(scheme));
    CHECK(speed_after(3, wave(Wave::ramp, 1, 2), scheme) == Approx(1 + 1).epsilon(1e-13));
    // before the first point the factor is 1; (1 - 3) / 2 and -3 / 4; 0 after the last
    CHECK(speed_after(3, p, scheme) == Approx(0.5 - 1 - 0.75).epsilon(1e-13));
  }
}

TEST_CASE("The wave behind a capacitor follows its equation from 0 on, without a jump") {
  for (const double phase : {0.0, 2.0, 4.0, -1.0}) {
    const double frequency = 0.7, T = 0.4;
    const Parameters p = wave(Wave::rc, frequency, T, phase);
    Waveform w(p);
    double before = 0;
    int pieces = 0;
    for (double t = 0; pieces < 9; ++pieces) {
      const double end = w.smooth_from(t), h = 1e-4, middle = (t + end) / 2;
      CHECK(w(t) == Approx(before).margin(1e-14));  // round-off of exponentials
      const double rate = (w(middle + h) - w(middle - h)) / (2 * h);
      const double source = std::sin(2 * pi * frequency * middle + phase) > 0 ? 1 : 0;
      CHECK(rate == Approx((source - w(middle)) / T).margin(1e-7));  // h^2 / 6 T^3
      Waveform anew(p);                                              // as after a resumption
      anew.smooth_from(t);
      CHECK(anew(end) == w(end));
      before = w(end);
      t = end;
    }
  }
}

TEST_CASE("JETSPIN's wave behind a capacitor begins each half period anew") {
  Waveform w(wave(Wave::restart, 0.5, 0.3));
  CHECK(w.smooth_from(0) == Approx(1));
  CHECK(w(0.2) == Approx(1 - std::exp(-0.2 / 0.3)));
  CHECK(w.smooth_from(1) == Approx(2));
  CHECK(w(1.2) == Approx(std::exp(-0.2 / 0.3)));
}

TEST_CASE("Each half period begins where the one before it ends, however its end is rounded") {
  for (double frequency : {1., 0.7, 3.1, 123.4})
    for (double phase : {0., 0.3, -2.}) {
      CAPTURE(frequency, phase);
      Waveform w(wave(Wave::square, frequency, 1, phase));
      bool ascending = true, alternating = true;
      double t = w.smooth_from(0), was = w(0);
      for (int k = 0; k < 2000; ++k) {
        const double end = w.smooth_from(t);
        ascending = ascending && end - t > 0.49 / frequency;
        alternating = alternating && w(t) == 1 - was;
        was = w(t);
        t = end;
      }
      CHECK(ascending);
      CHECK(alternating);
    }
}

TEST_CASE("A rotating field leads a free bead on a circle of radius q E / (m omega^2)") {
  const double omega = 2 * pi * 0.8, E = 1.7;
  const Parameters p = wave(Wave::rotating, 0.8);
  auto f = equations<3>(p, ElectricField<3>({0, E, E}, Waveform(p)));
  const double radius = E / (omega * omega);
  auto jet = jet_of<3>({{Vec<3>(5, -radius, 0), Vec<3>(0, 0, -omega * radius)}});
  for (int quarter = 1; quarter <= 4; ++quarter) {
    march_to<3>(quarter * pi / (2 * omega), 0.005, jet, f, p, Scheme::verner6);
    const double theta = quarter * pi / 2;
    // order 6 at omega h = 0.025: 1e-12
    CHECK(jet.y(0, 1) == Approx(-radius * std::cos(theta)).margin(1e-11));
    CHECK(jet.y(0, 2) == Approx(-radius * std::sin(theta)).margin(1e-11));
  }
}

TEST_CASE(
    "The field of needle and plate is minus the gradient of a harmonic potential, V at the tip, 0 at the "
    "plane") {
  const double R = 0.025, h = 16;
  const NeedleField field(R, h);
  CHECK(field.potential(Vec<3>(0, 0, 0)) == Approx(1).epsilon(1e-12));
  CHECK(field.potential(Vec<3>(h, 3, -2)) == Approx(0).margin(1e-12));
  // per volt, in V/cm: at the tip, in the middle of the gap
  CHECK(field(Vec<3>(0, 0, 0))[0] / h == Approx(10.2).epsilon(5e-3));
  CHECK(field(Vec<3>(8, 0, 0))[0] / h == Approx(0.0212).epsilon(5e-3));
  for (const Vec<3>& r : {Vec<3>(0.5, 0.3, -0.4), Vec<3>(3, 2, 1), Vec<3>(12, -5, 4)}) {
    const double d = 1e-3 * r.norm();
    double laplacian = -6 * field.potential(r), second = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec<3> step = d * Vec<3>::Unit(k);
      const double up = field.potential(r + step), down = field.potential(r - step);
      laplacian += up + down;
      second = std::max(second, std::abs(up + down - 2 * field.potential(r)));
      // central differences: (d / r)^2 = 1e-6 of the field near the tip's centre
      CHECK(field(r)[k] / h == Approx(-(up - down) / (2 * d)).margin(3e-6 * field(r).norm() / h));
    }
    CHECK(std::abs(laplacian) < 1e-5 * second);
  }
}

TEST_CASE("A bead that falls from needle to plate keeps its energy") {
  const double R = 0.05, h = 4, V = 0.6;
  Parameters p = plain_parameters();
  const NeedleField field(R, h);
  auto f = equations<3>(p, NeedlePlate<3>(V, field, Waveform()));
  auto jet = jet_of<3>({{Vec<3>(0.1, 0.05, -0.02), Vec<3>(0.3, 0, 0)}});
  const auto energy = [&] {
    return velocity<3>(jet.y, 0).squaredNorm() / 2 + V * h * field.potential(position<3>(jet.y, 0));
  };
  const double before = energy();
  march_to<3>(3, 1e-3, jet, f, p, Scheme::verner6);
  CHECK(jet.y(0, 0) > 2);
  // order 6: near the tip the field changes in times of 0.05, 50 steps
  CHECK(energy() == Approx(before).epsilon(1e-9));
}

TEST_CASE(
    "A jet of negative charge in a negative potential is the positive one, with the current turned round") {
  Parameters p = with_tolerance(example("pvp"), 1e-6);
  Run<3> positive(p);
  const auto currents = recorded(positive, {"curn"}, 1e-3, 2e-3);
  p.density_charge = -p.density_charge;
  p.external_potential = -p.external_potential;
  Run<3> negative(p);
  const auto opposite = recorded(negative, {"curn"}, 1e-3, 2e-3);
  CHECK((negative.jet().y == positive.jet().y).all());
  CHECK(currents.back()[0] > 0);
  CHECK(opposite.back()[0] == -currents.back()[0]);
}

TEST_CASE("Two rates go on through a square wave, whose jumps end steps, and stay out of a rotating field") {
  Parameters p = with_tolerance(example("pvp"), 1e-6);
  p.field_wave = Wave::square;
  p.field_frequency = 400;
  Run<3> one(p);
  one.to(6e-3);
  p.multirate = Multirate::automatic;
  Run<3> two(p);
  two.to(6e-3);
  REQUIRE(two.scene.multirate);
  CHECK(two.x() == Approx(one.x()).margin(5e-5));  // half of what tolerance 1e-6 stands for
  p.field_wave = Wave::rotating;
  p.field_vector = {30, 10, 10};
  CHECK_FALSE(Run<3>(p).scene.multirate);
}
