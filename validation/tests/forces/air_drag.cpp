/// Drag and lift of the air: closed answers, symmetry, derivatives, and runs by every way of stepping.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/jet/stiffness.hpp"
#include "forces/terms/air_drag.hpp"
#include "forces/terms/gravity.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

using std::numbers::pi;

constexpr Section thin{0.05, 1};  ///< of elements of length 1

/// JETSPIN's example 4: the paper's jet in air that comes from the collector at 10 m/s.
Parameters counter_flow(double tolerance, Scheme scheme = Scheme::automatic) {
  Parameters p = with_tolerance(example("pvp"), tolerance, scheme);
  p.airdrag = true;
  p.air_density = 0.00121;
  p.air_viscosity = 0.1511;
  p.air_velocity = -1000;
  return p;
}

/// Beads along a line across the way they move.
Jet<3> broadside(double speed) {
  std::vector<Bead<3>> beads;
  for (int i = 5; i >= 1; --i) beads.push_back({Vec<3>(i, 0, 0), Vec<3>(0, 0, speed)});
  return jet_of<3>(beads);
}

/// A crooked jet whose beads move in all directions.
Jet<3> crooked() {
  return jet_of<3>({{Vec<3>(4.2, 0.3, -0.2), Vec<3>(2, -1, 0.5), 0, 0.7},
                    {Vec<3>(3.1, -0.2, 0.4), Vec<3>(1.5, 0.8, -0.6), 0, 1.3},
                    {Vec<3>(1.9, 0.5, 0.1), Vec<3>(-0.4, 0.2, 0.9), 0, 1.1},
                    {Vec<3>(0.8, 0.1, 0.3), Vec<3>(0.6, -0.7, 0.3)}});
}

template <int D>
Eigen::Array<double, Eigen::Dynamic, D> accelerations(EquationsOfMotion<D>& f, const Jet<D>& jet) {
  return slope(f, jet).template middleCols<D>(velocity_column<D>);
}

/// Greatest difference between the blocks by velocity and central differences of the accelerations.
template <int D>
double error_of_derivative(EquationsOfMotion<D>& f, const Jet<D>& jet) {
  LocalJacobian<D> J;
  f.differentiate(jet, 0, jet.y, J);
  const double h = 1e-5;
  double worst = 0;
  for (Eigen::Index i = 0; i < jet.size(); ++i)
    for (int k = 0; k < D; ++k) {
      auto more = jet, less = jet;
      more.y(i, velocity_column<D> + k) += h;
      less.y(i, velocity_column<D> + k) -= h;
      const Eigen::Array<double, Eigen::Dynamic, D> difference =
          (accelerations(f, more) - accelerations(f, less)) / (2 * h);
      const auto block = J.acceleration_by_v[std::size_t(i)].col(k).transpose().array();
      worst = std::max(worst, (block - difference.row(i)).abs().maxCoeff());
    }
  return worst;
}

}  // namespace

TEST_CASE("Drag along a jet that grows in length slows it down as energy tells") {
  // m v dv/dl = - C l^0.905 v^1.19 , hence  v^0.81 + 0.81 C / 1.905 l^1.905  stays
  const Gas gas{0.3, 0.2, 0};
  const double C = 0.65 * pi * gas.density * std::pow(2 / gas.viscosity, -0.81) * std::pow(thin.radius, 0.19);
  const auto conserved = [&](const Jet<1>& jet) {
    return std::pow(jet.y(0, 1), 0.81) + 0.81 * C / 1.905 * std::pow(jet.y(0, 0), 1.905);
  };
  for (Scheme scheme : {Scheme::rk4, Scheme::verner6, Scheme::kencarp5}) {
    CAPTURE(name(scheme));
    auto f = equations<1>(plain_parameters(), AirDrag<1>(gas, thin, DragModel::jetspin));
    auto jet = jet_of<1>({bead_at(1, 2)});
    const double before = conserved(jet);
    march_to<1>(3, 0.01, jet, f, plain_parameters(), scheme);
    CHECK(jet.y(0, 1) < 1.6);  // a fifth of its speed is lost
    // 300 steps of order 4 or more: h^4 times derivatives of order 1
    CHECK(conserved(jet) == Approx(before).epsilon(1e-8));
  }
}

TEST_CASE("A jet that falls along itself stops to speed up at (m g / C)^(1/1.19)") {
  const Gas gas{0.3, 0.2, 0};
  const double g = 0.4, l = 2.5;
  const double C = 0.65 * pi * gas.density * std::pow(2 / gas.viscosity, -0.81) *
                   std::pow(thin.radius, 0.19) * std::pow(l, 0.905);
  auto f = equations<1>(plain_parameters(), AirDrag<1>(gas, thin, DragModel::jetspin), Gravity<1>(g));
  const auto acceleration = [&](double v) {
    return slope(f, jet_of<1>({bead_at(1 + l, v), bead_at(1, v)}))(0, 1);
  };
  const double terminal = std::pow(g / C, 1 / 1.19);
  CHECK(std::abs(acceleration(terminal)) < 1e-13 * g);  // round-off of powers
  CHECK(acceleration(0.9 * terminal) > 0.1 * g);
  CHECK(acceleration(1.1 * terminal) < -0.1 * g);
}

TEST_CASE("A cylinder that falls broadside feels the drag that Sucker and Brauer have measured") {
  const Gas gas{0.3, 0.2, 0};
  const double radius = thin.radius;
  auto f = equations<3>(plain_parameters(), AirDrag<3>(gas, thin, DragModel::full));
  // C_n by the formula in another language
  for (const auto& [Re, C_n] : {std::pair{0.01, 430.520514530563},
                                {0.1, 60.1628281446812},
                                {1.0, 9.9396000001456},
                                {10.0, 2.67181626213903},
                                {100.0, 1.4489969816439}}) {
    const double speed = Re * gas.viscosity / (2 * radius);
    const auto a = accelerations(f, broadside(speed));
    CAPTURE(Re);
    // beads between two elements bear one; round-off of a power
    for (int i = 1; i < 5; ++i)
      CHECK(a(i, 2) == Approx(-radius * gas.density * C_n * speed * speed).epsilon(1e-12));
    CHECK(a(0, 2) == Approx(a(1, 2) / 2).epsilon(1e-12));  // the free end bears a half
    CHECK(a.leftCols<2>().abs().maxCoeff() == 0);
  }
}

TEST_CASE("Slow flow across a cylinder has Lamb's drag, and the slowest is proportional to the speed") {
  const Gas gas{1, 1, 0};
  const auto C_n = [&](double Re) { return across(gas, 0.5, Re).value / (0.5 * Re); };
  const double Re = 0.1, S = 0.5 - std::numbers::egamma + std::log(8 / Re);
  // Kaplun's next term of the expansion in 1 / S is 0.87 / S^2 = 5 % of Lamb's
  CHECK(C_n(Re) == Approx(8 * pi / (Re * S)).epsilon(0.05));
  CHECK(across(gas, 0.5, 1e-9).value == across(gas, 0.5, 5e-5).value);
  CHECK(across(gas, 0.5, 0.99999e-4).value == Approx(across(gas, 0.5, 1.00001e-4).value).epsilon(1e-5));
}

TEST_CASE("Drag turns round with the wind, and only the wind counts") {
  for (const DragModel model : {DragModel::jetspin, DragModel::full}) {
    auto still = equations<3>(plain_parameters(), AirDrag<3>({0.3, 0.2, 0}, thin, model),
                              AirLift({0.3, 0.2, 0}, thin));
    auto blowing = equations<3>(plain_parameters(), AirDrag<3>({0.3, 0.2, 1.5}, thin, model),
                                AirLift({0.3, 0.2, 1.5}, thin));
    auto carried = crooked();
    carried.y.col(3) += 1.5;
    const auto a = accelerations(still, crooked());
    CHECK((accelerations(blowing, carried) - a).abs().maxCoeff() < 1e-14 * a.abs().maxCoeff() * 10);

    auto drag = equations<3>(plain_parameters(), AirDrag<3>({0.3, 0.2, 0}, thin, model));
    auto backwards = crooked();
    backwards.y.middleCols<3>(3) *= -1;
    CHECK((accelerations(drag, backwards) == -accelerations(drag, crooked())).all());
  }
}

TEST_CASE("Lift drives a bead on a circle outwards by rho w^2 pi a^2 / R on its length") {
  const Gas gas{0.3, 0.2, 0};
  const double R = 20, chord = 1, angle = 2 * std::asin(chord / (2 * R)), speed = 1.7;
  std::vector<Bead<3>> beads;
  for (int i = 3; i >= 0; --i) {
    const double phi = i * angle;
    beads.push_back({Vec<3>(10 + R * std::sin(phi), 5 - R * std::cos(phi), 0), Vec<3>(0, 0, 0)});
  }
  auto jet = jet_of<3>(beads);
  const Vec<3> t = (position<3>(jet.y, 1) - position<3>(jet.y, 2)).normalized();
  jet.y.row(1).segment<3>(3) = speed * t.transpose().array();
  auto f = equations<3>(plain_parameters(), AirLift(gas, thin));
  const Vec<3> a = accelerations(f, jet).row(1).matrix().transpose();
  const Vec<3> outwards = (position<3>(jet.y, 1) - Vec<3>(10, 5, 0)).normalized();
  const double expected = gas.density * speed * speed * pi * thin.radius * thin.radius / R;
  CHECK((a - expected * outwards).norm() < 1e-12 * expected);  // round-off of a curvature, R / l times 1e-16
}

TEST_CASE(
    "As JETSPIN 1.20 computes it, drag points to the nozzle whichever way the wind blows, and 1 cm is "
    "lifted") {
  const Gas gas{0.3, 0.2, 0};
  const auto of_model = [&](DragModel model, double sign) {
    auto jet = crooked();
    jet.y.middleCols<3>(3) *= sign;
    auto f = equations<3>(plain_parameters(), AirDrag<3>(gas, thin, model));
    return accelerations(f, jet);
  };
  const auto odd = of_model(DragModel::jetspin, 1), theirs = of_model(DragModel::jetspin_1_20, 1);
  CHECK((odd.abs() == theirs.abs()).all());
  CHECK((of_model(DragModel::jetspin_1_20, -1) == theirs).all());
  const Chain<3> chain = chain_of<3>(crooked(), Nozzle<3>(plain_parameters()));
  int turned = 0;
  for (Eigen::Index i = 0; i < theirs.rows(); ++i) {
    const double along = theirs.row(i).matrix().dot(chain.tangent.row(i).matrix());
    CHECK(along < 0);
    turned += odd.row(i).matrix().dot(chain.tangent.row(i).matrix()) > 0;
  }
  CHECK(turned > 0);  // some beads of the crooked jet move towards the nozzle along it

  auto lift = equations<3>(plain_parameters(), AirLift(gas, thin)),
       of_length = equations<3>(plain_parameters(), AirLift(gas, thin, 3.5));
  const auto own = accelerations(lift, crooked()), given = accelerations(of_length, crooked());
  const Eigen::Index inner = 1;  // which has an element on either side
  CHECK(own.row(inner).abs().maxCoeff() > 0);
  CHECK((given.row(inner) - 3.5 * chain.inverse_length[inner] * own.row(inner)).abs().maxCoeff() <
        1e-14 * given.row(inner).abs().maxCoeff());
}

TEST_CASE("The derivatives of drag and lift by the velocity are those of differences") {
  const Gas gas{0.3, 0.2, -0.7};
  // central differences err by h^2 = 1e-10 times third derivatives of order 10, and by round-off / h = 1e-11
  for (const DragModel model : {DragModel::jetspin, DragModel::jetspin_1_20, DragModel::full}) {
    auto f = equations<3>(plain_parameters(), AirDrag<3>(gas, thin, model), AirLift(gas, thin));
    CHECK(error_of_derivative<3>(f, crooked()) < 1e-8);
    auto straight = equations<1>(plain_parameters(), AirDrag<1>(gas, thin, model));
    CHECK(error_of_derivative<1>(straight, jet_of<1>({bead_at(2, 1.5), bead_at(1, 0.2)})) < 1e-8);
  }
}

TEST_CASE("The air of JETSPIN's example 4 has the groups that it prints") {
  const Parameters p = counter_flow(1e-6);
  // Lambda, five digits, which JETSPIN 1.20 leaves in units of 1/cm
  CHECK(air(p).density / scales(p).length == Approx(1.1165).epsilon(5e-5));
  const Section section{p.nozzle_cross / scales(p).length, groups(p).L_step};
  Gas at_rest = air(p);
  at_rest.velocity = 0;
  auto f = equations<1>(plain_parameters(), AirDrag<1>(at_rest, section, DragModel::jetspin));
  // Gamma, four digits: the drag on an element of length 1 at speed 1
  CHECK(accelerations(f, jet_of<1>({bead_at(1, 1)}))(0, 0) == Approx(-2.614e-3).epsilon(3e-4));
}

TEST_CASE("A jet in counter-flow comes out alike by one rate, two rates and the stiff scheme") {
  const double end = 0.009;
  for (const DragModel model : {DragModel::jetspin, DragModel::full}) {
    Parameters p = counter_flow(1e-6);
    p.drag_model = model;
    Run<3> one(p);
    one.to(end);
    p.multirate = Multirate::automatic;
    Run<3> two(p);
    two.to(end);
    REQUIRE(two.scene.multirate);
    CHECK(two.beads() == one.beads());
    // 1e-4 cm is what tolerance 1e-6 stands for in case 3; the continuation may take half of it
    CHECK(two.x() == Approx(one.x()).margin(5e-5));
    CHECK(two.yz() == Approx(one.yz()).margin(5e-5));
    Parameters stiff = counter_flow(1e-6, Scheme::kencarp5);
    stiff.drag_model = model;
    Run<3> implicit_run(stiff);
    implicit_run.to(end);
    CHECK(implicit_run.x() == Approx(one.x()).margin(1e-4));
    Run<3> calm(with_tolerance(example("pvp"), 1e-6));
    calm.to(end);
    CHECK(calm.x() - one.x() > 0.1);  // the air is felt
  }
}

TEST_CASE(
    "A fibre that the air stops within microseconds takes the stiff scheme, whose step it does not bind") {
  const auto fibre = [](Scheme scheme) {
    Parameters p = counter_flow(1e-5, scheme);
    p.drag_model = DragModel::full;
    p.inserting = p.removing = false;
    p.nozzle_cross = 2e-5;
    p.points = 20;
    p.initial_length = 1;
    p.air_velocity = 100;
    return p;
  };
  const Parameters p = fibre(Scheme::automatic);
  CHECK(stiffness(p).drag_rate > 1e6);
  CHECK(chosen_scheme(p) == Scheme::kencarp5);
  Run<3> explicit_run(fibre(Scheme::verner6)), additive_run(p);
  const double end = 6e-3;
  const Effort by_explicit = explicit_run.to(end), by_additive = additive_run.to(end);
  CAPTURE(by_explicit.steps, by_additive.steps, stiffness(p).drag_rate);
  CHECK(by_explicit.steps > 5 * by_additive.steps);
  // what a step may err at this tolerance is a hundredth of an element
  CHECK(additive_run.x() == Approx(explicit_run.x()).margin(1e-2 * explicit_run.unit.l_step));
  CHECK(additive_run.yz() == Approx(explicit_run.yz()).margin(1e-2 * explicit_run.unit.l_step));
}
