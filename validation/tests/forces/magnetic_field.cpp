/// The force of a magnetic field on moving charges: helices, drift, units, and its place among the others.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/jet/stiffness.hpp"
#include "forces/terms/external_field.hpp"
#include "forces/terms/magnetic_field.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

using std::numbers::pi;

constexpr double charge = 1.5, mass = 2,
                 turn = charge / mass;  ///< of the bead, its radians a time where |M| = 1

Jet<3> flying(const Vec<3>& r, const Vec<3>& v) {
  auto jet = jet_of<3>({{r, v, 0, mass}});
  jet.charge[0] = charge;
  return jet;
}

/// Case 3, whose beads go round with `gauss` along z.
Parameters turned(double gauss, const std::vector<std::string>& more = {}) {
  std::vector<std::string> lines = {fmt::format("magnetic field 0 0 {}", gauss)};
  lines.insert(lines.end(), more.begin(), more.end());
  return example("pvp", lines);
}

}  // namespace

TEST_CASE("A charge goes round a helix along the magnetic field, positive ones as the left hand has it") {
  auto f = equations<3>(plain_parameters(), MagneticField({0, 0, 1}));
  const Vec<3> r(20, 1, -2), v(0.6, 0, 0.3);
  Jet<3> jet = flying(r, v);
  const double t = 5, angle = turn * t, radius = 0.6 / turn;
  march_to<3>(t, 0.01, jet, f, plain_parameters(), Scheme::rk4);
  // dv/dt = turn v x z turns v from x to -y; RK4 errs by turn^5 h^4 t / 120 = 1e-10
  const Vec<3> expected(20 + radius * std::sin(angle), 1 - radius * (1 - std::cos(angle)), -2 + 0.3 * t);
  CHECK((position<3>(jet.y, 0) - expected).norm() < 1e-9);
  CHECK(velocity<3>(jet.y, 0).norm() == Approx(v.norm()).epsilon(1e-9));  // no work is done
}

TEST_CASE("In crossed fields a charge that starts at rest drifts along E x B on a cycloid") {
  const Vec<3> E(0.02, 0, 0), M(0, 0.3, 0.4);
  auto f = equations<3>(plain_parameters(), ElectricField<3>({E[0], E[1], E[2]}, Waveform()),
                        MagneticField({M[0], M[1], M[2]}));
  const Vec<3> r(30, 0, 0), drift = E.cross(M) / M.squaredNorm();
  Jet<3> jet = flying(r, Vec<3>::Zero());
  const double period = 2 * pi / (turn * M.norm());
  march_to<3>(period, period / 2000, jet, f, plain_parameters(), Scheme::rk4);
  // after a whole period it is at rest again; RK4 errs by (2 pi / 2000)^4 2 pi / 120 of the way, 1e-11 of 0.7
  CHECK((position<3>(jet.y, 0) - (r + drift * period)).norm() < 1e-10);
  CHECK(velocity<3>(jet.y, 0).norm() < 1e-10);
}

TEST_CASE("One tesla turns a bead of case 3 as far as the SI has it, in whichever units a deck says so") {
  const double coulomb_per_cm3 = 44000 / 2997924580.0, kilogram_per_cm3 = 0.839253525e-3;
  const double per_second = coulomb_per_cm3 / kilogram_per_cm3;  // q B / m with B = 1 T
  const Parameters in_gauss = turned(1e4);
  // the SI's factor of the charge and the speed of light cancel but for round-off
  CHECK(magnetic_groups(in_gauss)[2] / scales(in_gauss).time == Approx(per_second).epsilon(1e-14));
  CHECK(stiffness(in_gauss).turn_rate == Approx(per_second).epsilon(1e-14));
  Parameters in_tesla = in_gauss;
  in_tesla.units = Units::real;
  in_tesla.magnetic_field = {0, 0, 1};
  in_tesla.density_charge = coulomb_per_cm3 * 1000;  // C/L
  CHECK(magnetic_groups(in_tesla)[2] == Approx(magnetic_groups(in_gauss)[2]).epsilon(1e-14));
}

TEST_CASE("The derivative of the magnetic force by the velocity is the matrix of its turn") {
  auto f = equations<3>(plain_parameters(), MagneticField({0.3, -0.7, 1.1}));
  Jet<3> jet = flying({10, 1, 2}, {0.6, -0.2, 0.3});
  LocalJacobian<3> J;
  f.differentiate(jet, 0, jet.y, J);
  for (int k = 0; k < 3; ++k) {
    jet.y.row(0).segment<3>(velocity_column<3>) = Vec<3>::Unit(k).transpose().array();
    const Vec<3> a = slope(f, jet).row(0).segment<3>(velocity_column<3>).matrix().transpose();
    CHECK((J.acceleration_by_v[0].col(k) - a).norm() < 1e-15);  // the force is linear: round-off
  }
}

TEST_CASE("A held bead feels the magnetic field as one that moves at the mean of nozzle and youngest bead") {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.feed = Feed::flow;
  p.flow_rate = 0.01;
  const Nozzle<3> nozzle(p);
  Jet<3> jet = jet_of<3>({Bead<3>({2, 0.4, 0}, {1, 0.2, 0.5})});
  jet.held = true;
  jet.t = 0.5 / nozzle.feed().flow();
  const Chain<3> chain = chain_of<3>(jet, nozzle);
  const Vec<3> M(0.3, -0.7, 1.1), v = (Vec<3>(1, 0.2, 0.5) + nozzle.velocity(jet.t)) / 2;
  CHECK((MagneticField({M[0], M[1], M[2]}).on_held(chain) - v.cross(M)).norm() < 1e-15);  // round-off
}

TEST_CASE("Case 3 in a strong magnetic field is the same jet by two rates, one rate and the stiff scheme") {
  const double end = 0.004;
  const auto jet_of_scheme = [&](const std::vector<std::string>& lines) {
    Run<3> run(with_tolerance(turned(2e9, lines), 1e-7));
    run.to(end);
    return run.jet().y;
  };
  const State<3> two = jet_of_scheme({}), one = jet_of_scheme({"multirate no"}),
                 stiff = jet_of_scheme({"integrator kencarp5"});
  REQUIRE(two.rows() == one.rows());
  REQUIRE(stiff.rows() == one.rows());
  const double unit = scales(example("pvp")).length;
  const auto apart = [&](const State<3>& y) { return unit * (y - one).leftCols<3>().abs().maxCoeff(); };
  // 1e-7 of the collector distance, and what locating some 90 releases adds
  CHECK(apart(two) < 1e-5);
  CHECK(apart(stiff) < 1e-5);
  Run<3> without(with_tolerance(example("pvp"), 1e-7));
  without.to(end);
  CHECK(unit * std::abs(one(0, 1) - without.jet().y(0, 1)) > 0.1);  // the field is felt by the oldest bead
}

TEST_CASE("Where a magnetic field turns beads within their interval, one rate is taken") {
  CHECK_FALSE(stiffness(turned(1e9)).relaxes_between_beads());
  CHECK(stiffness(turned(1e12)).relaxes_between_beads());
}
