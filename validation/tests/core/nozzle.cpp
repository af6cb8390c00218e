/// The nozzle: its circle, the held bead and its charge, and what is continuous when a bead is released.

#include <catch2/catch.hpp>
#include <numbers>

#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

Parameters circling() {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.nozzle_velocity = 0.3;
  p.perturb = true;
  p.perturb_frequency = 4;
  p.perturb_amplitude = 0.05;
  return p;
}

/// Strain rate of element i as the force terms see it.
double strain_rate(const Jet<3>& jet, const Nozzle<3>& nozzle, Eigen::Index i) {
  return chain_of<3>(jet, nozzle).strain_rate[i];
}

}  // namespace

TEST_CASE("The nozzle stays on its circle at any time and its velocity is the derivative") {
  const Nozzle<3> nozzle(circling());
  for (double t : {0.0, 0.1, 1.0, 17.3, 1e4}) {
    CAPTURE(t);
    const Vec<3> r = nozzle.position(t), v = nozzle.velocity(t);
    CHECK(r[0] == 0);
    CHECK(r.norm() == Approx(0.05).epsilon(1e-15));
    CHECK(v[0] == Approx(0.3).epsilon(1e-15));
    // exact: v = omega x r; the phase at t = 1e4 carries 4e4 * 1e-16 of round-off
    CHECK(v[1] == Approx(-4 * r[2]).margin(2e-12));
    CHECK(v[2] == Approx(4 * r[1]).margin(2e-12));
  }
  CHECK(nozzle.position(0)[1] == 0.05);
  CHECK(nozzle.position(0)[2] == 0);
  // a full turn
  CHECK((nozzle.position(2 * std::numbers::pi / 4) - nozzle.position(0)).norm() < 1e-16);
}

TEST_CASE("Without perturbation, and on a straight jet, the nozzle is at rest at the origin") {
  Parameters p = circling();
  CHECK(Nozzle<1>(p).position(0.3)[0] == 0);
  p.perturb = false;
  CHECK(Nozzle<3>(p).position(0.3).norm() == 0);
  CHECK(Nozzle<3>(p).velocity(0.3) == Vec<3>(0.3, 0, 0));
}

TEST_CASE("The held bead waits on the chord to the youngest bead, one element from the nozzle") {
  const Nozzle<3> nozzle(circling());
  const Vec<3> r(1.2, 0.7, -0.4);
  for (double t : {0.0, 0.37, 2.0}) {
    const Vec<3> n = nozzle.position(t), held = nozzle.held(jet_of<3>({{r}}), r, t).position;
    CHECK((held - n).norm() == Approx(1).epsilon(1e-15));
    CHECK((held - n).cross(r - n).norm() < 1e-15);
    CHECK((held - n).dot(r - n) > 0);
  }
}

TEST_CASE("The charge of the held bead rises from 0 to 1 with no slope at either end") {
  const FeedByPull<3> feed(1, 0, /*release_waits*/ false);
  const auto s = [&](double d) { return feed.faded_charge(d); };
  CHECK(s(1.2) == 0);
  CHECK(s(2) == 1);
  CHECK(s(1.75) == Approx(0.5).epsilon(1e-14));
  const double e = 1e-4;
  // s = pi^2 e^2 + O(e^4): second order in the distance from the end, hence a continuous slope
  const double rise = std::numbers::pi * std::numbers::pi * e * e;
  CHECK(s(1.5 + e) == Approx(rise).epsilon(1e-6));
  CHECK(1 - s(2 - e) == Approx(rise).epsilon(1e-6));
  for (double d = 1.5; d < 2; d += 0.01) CHECK(s(d + 0.01) > s(d));
}

TEST_CASE("The held bead acts on others with its faded charge and is no row of the table") {
  const Parameters p = circling();
  const Nozzle<3> nozzle(p);
  const Vec<3> youngest(1.7, 0.2, 0);
  Jet<3> jet = jet_of<3>({{Vec<3>(3, 0, 0)}, {youngest}});
  nozzle.place(jet);
  CHECK(jet.size() == 2);
  Chain<3> chain;
  set_boundary<3>(chain, jet, nozzle, 0.2, jet.y);
  CHECK(chain.points() == 4);
  const double d = (youngest - nozzle.position(0.2)).norm() / nozzle.l_step();
  const FeedByPull<3> feed(nozzle.l_step(), 0, /*release_waits*/ false);
  CHECK(chain.point_charge[2] == Approx(feed.faded_charge(d)).epsilon(1e-14));
  CHECK(chain.point_charge[3] == 1);
}

TEST_CASE("A release keeps the strain rate of the element below and makes an unstressed bead on the chord") {
  Parameters p = circling();
  p.perturb = false;
  const Nozzle<3> nozzle(p);
  const Vec<3> way = Vec<3>(2, -1, 2) / 3;
  Jet<3> jet = jet_of<3>({{Vec<3>(4, 0, 0), Vec<3>(7, 0, 0), 0.5}, {2 * way, Vec<3>(5, 1, -0.5), 0.25}});
  nozzle.place(jet);
  const double before = strain_rate(jet, nozzle, 1);
  nozzle.release(jet);
  REQUIRE(jet.size() == 3);
  CHECK_FALSE(jet.held);
  CHECK((position<3>(jet.y, 2) - way).norm() < 1e-15);
  CHECK(jet.y(1, stress_column<3>) == 0.25);
  CHECK(jet.y(2, stress_column<3>) == 0);
  CHECK(velocity<3>(jet.y, 2) == Vec<3>(2.65, 0.5, -0.25));  // half of its predecessor's above the nozzle's
  CHECK(strain_rate(jet, nozzle, 1) == Approx(before).epsilon(1e-14));
}

TEST_CASE("A nozzle that circles wider than an element begins by letting a bead go") {
  for (const EventRule events : {EventRule::located, EventRule::step}) {
    // the bead next to the nozzle is on the axis, sqrt(1 + 2^2) elements from it
    const std::string deck = fmt::format("{}/examples/pvp/input.dat", TREEJET_SOURCE_DIR);
    Parameters p = with_steps(read_deck(deck, {"points 40"}).parameters, Scheme::rk4, 1e-9);
    p.events = events;
    Run<3> run(p);
    const Effort effort = run.to(1e-8);
    CHECK(effort.released == 1);
    REQUIRE(run.jet().size() == 41);
    const double l_step = run.scene.nozzle.l_step();
    const Vec<3> from_nozzle = position<3>(run.jet().y, 40) - run.scene.nozzle.position(run.jet().t);
    // meanwhile the nozzle has gone a ten-thousandth of a radian on its circle, whose radius is two elements
    CHECK(from_nozzle.norm() == Approx(l_step).epsilon(2e-4));
    CHECK(position<3>(run.jet().y, 39).norm() == Approx(l_step).epsilon(1e-4));
    CHECK(run.jet().y.isFinite().all());
  }
}

TEST_CASE("Where events are seen at step ends a held bead keeps its whole charge until its release") {
  const FeedByPull<3> waiting(1, 0, /*release_waits*/ true), located(1, 0, /*release_waits*/ false);
  CHECK(waiting.faded_charge(2.3) == 1);
  CHECK(located.faded_charge(2.3) < 1);  // a step that overshoots is cut there
  CHECK(waiting.faded_charge(1.75) == located.faded_charge(1.75));
}

TEST_CASE("A circling nozzle is accelerated towards the middle of its circle") {
  const Nozzle<3> nozzle(circling());
  for (double t : {0.0, 0.37, 2.0}) {
    const Vec<3> expected = -16 * nozzle.position(t);  // omega^2 = 4^2
    CHECK((nozzle.acceleration(t) - expected).norm() < 1e-15);
  }
}

TEST_CASE("A bead that is released by flow has the columns of the element that it is cut from") {
  Parameters p = circling();
  p.feed = Feed::flow;
  p.flow_rate = 0.01;
  const Nozzle<3> nozzle(p, {Column{.name = "solvent", .unit = "1", .at_birth = 0.9}});
  Jet<3> jet = jet_of<3>({with_added<3>(Vec<3>(1.5, 0, 0), 0.3)});
  jet.held = true;
  jet.t = 1.2 / nozzle.feed().flow();  // late by a fifth
  nozzle.release(jet);
  REQUIRE(jet.size() == 2);
  CHECK(jet.y(1, own_columns<3>) == 0.3);
  // the next bead is due one interval after this one was, not after it was seen
  CHECK(jet.last_release == Approx(1 / nozzle.feed().flow()).epsilon(1e-14));
}
