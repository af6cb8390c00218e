/// A jet fed by a given flow: what is conserved, what is continuous, and closed answers.

#include <catch2/catch.hpp>
#include <numbers>

#include "forces/terms/external_field.hpp"
#include "forces/terms/gravity.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "forces/terms/surface_energy.hpp"
#include "forces/terms/viscoelastic.hpp"
#include "integrators/schemes/chain_solver.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;
using std::numbers::pi;

namespace {

constexpr double flow = 0.4;  ///< elements a unit of time, as long and fast as that

/// Fed by flow, in a chain of elements of scaled length 1 and radius 0.1; `circles`: the nozzle.
Parameters fed(bool circles = true) {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.feed = Feed::flow;
  p.flow_rate = flow * pi * p.nozzle_cross * p.nozzle_cross;
  if (circles) {
    p.perturb = true;
    p.perturb_frequency = 3;
    p.perturb_amplitude = 0.05;
  }
  return p;
}

/// A crooked jet whose youngest element has the volume V.
Jet<3> crooked(double V) {
  Jet<3> jet = jet_of<3>({{Vec<3>(6, 0.3, 0), Vec<3>(2, 0.1, 0), 0.7},
                          {Vec<3>(4.4, -0.2, 0.1), Vec<3>(1.6, 0, 0.3), 0.6},
                          {Vec<3>(3.1, 0.2, -0.2), Vec<3>(1.1, 0.2, -0.1), 0.5},
                          {Vec<3>(1.7, 0.3, 0.4), Vec<3>(0.9, -0.1, 0.2), 0.4}});
  jet.t = 0.2;
  jet.last_release = jet.t - (V - 1) / flow;
  jet.held = true;
  return jet;
}

struct Sums {
  double mass = 0, charge = 0, volume = 0;
  Vec<3> momentum = Vec<3>::Zero(), dipole = Vec<3>::Zero();
};

/// Of beads, held bead and the nozzle's half bead.
Sums sums(const Jet<3>& jet, const Nozzle<3>& nozzle) {
  Sums s;
  const auto add = [&](double m, double q, const Vec<3>& v, const Vec<3>& r) {
    s.mass += m, s.charge += q, s.momentum += m * v, s.dipole += q * r;
  };
  const Eigen::Index n = jet.size() - 1;
  for (Eigen::Index i = 0; i <= n; ++i) {
    add(jet.mass[i], jet.charge[i], velocity<3>(jet.y, i), position<3>(jet.y, i));
    s.volume += i < n ? jet.volume[i] : nozzle.volume_of_youngest(jet);
  }
  const Vec<3> at = nozzle.position(jet.t), v = nozzle.velocity(jet.t);
  const auto held = nozzle.held(jet, position<3>(jet.y, n), jet.t);
  add(held.mass, held.charge, (velocity<3>(jet.y, n) + v) / 2, held.position);
  add(0.5, Nozzle<3>::charge, v, at);
  return s;
}

/// Keeps account of a run fed by flow.
template <int D>
struct Books final : Observer<D> {
  explicit Books(const Nozzle<D>& nozzle) : nozzle_(nozzle) {}
  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override {
    Jet<D> end = at(jet, segment.until, segment.at(segment.until));
    before_ = momentum(end);
  }
  void event(EventKind kind, const Jet<D>& jet) override {
    if (kind == EventKind::removal) removed += jet.mass[0];
    if (kind != EventKind::place) return;  // the end of a release
    ++releases;
    const double mass = jet.mass.sum() + nozzle_.volume_of_youngest(jet) - 1 + removed;
    const double given = first_ + jet.t * nozzle_.feed().flow();
    mass_error = std::max(mass_error, std::abs(mass - given) / given);
    const Vec<D> p = momentum(jet);
    momentum_error = std::max(momentum_error, (p - before_).norm() / p.norm());
  }
  void start(const Jet<D>& jet) override { first_ = jet.mass.sum(); }

  int releases = 0;
  double removed = 0, mass_error = 0, momentum_error = 0;

 private:
  Vec<D> momentum(const Jet<D>& jet) const {
    Vec<D> p = Vec<D>::Zero();
    for (Eigen::Index i = 0; i < jet.size(); ++i) p += jet.mass[i] * velocity<D>(jet.y, i);
    const double s = nozzle_.volume_of_youngest(jet) - 1;
    return p + s * (velocity<D>(jet.y, jet.size() - 1) + nozzle_.velocity(jet.t)) / 2;
  }

  const Nozzle<D>& nozzle_;
  double first_ = 0;
  Vec<D> before_ = Vec<D>::Zero();
};

template <int D>
void balance(const Parameters& p, double end) {
  Run<D> run(p);
  Books<D> books(run.scene.nozzle);
  run.to(end, {&books});
  CHECK(books.releases >= 100);
  CHECK(books.removed > 20);
  CHECK(books.mass_error < 1e-13);      // a hundred sums of times, near 1e-15 each
  CHECK(books.momentum_error < 1e-13);  // the end of a step against the dense output there
}

/// What J says of the slope's answer to a small change of the state.
State<3> answer(const LocalJacobian<3>& J, const State<3>& change) {
  const Eigen::Index n = change.rows();
  State<3> rate = State<3>::Zero(n, own_columns<3>);
  Vec<3> below = Vec<3>::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& e = J.element[std::size_t(i)];
    Vec<3> d = position<3>(change, i), w = velocity<3>(change, i);
    if (i + 1 < n) d -= position<3>(change, i + 1), w -= velocity<3>(change, i + 1);
    const double stress = change(i, stress_column<3>);
    const Vec<3> tension = e.tension_by_d * d + e.tension_by_w * w + e.tension_by_stress * stress;
    Vec<3> a = J.inverse_mass[i] * (below - tension);
    if (!J.acceleration_by_v.empty()) a += J.acceleration_by_v[std::size_t(i)] * velocity<3>(change, i);
    rate.row(i).head<3>() = velocity<3>(change, i).transpose().array();
    rate.row(i).segment<3>(3) = a.transpose().array();
    rate(i, stress_column<3>) = e.stress.by_strain_rate[0] * (e.rate_by_d.dot(d) + e.rate_by_w.dot(w)) +
                                e.stress.by_state(0, 0) * stress;
    below = tension;
  }
  return rate;
}

/// Speed and stress, v and sigma, at x of a steady straight Maxwell jet of section Q / v in a uniform force
/// f on its volume; density, modulus and relaxation time 1:
///     v v' = sigma' - sigma v' / v + f ,      v sigma' = v' - sigma ,      v(0) given, sigma(0) = 0 .
/// Faster than the fluid's elastic waves, v^2 > 1 - sigma, it is a problem of initial values.
std::pair<double, double> steady_jet(double v, double f, double x) {
  double sigma = 0;
  const int steps = 4000;
  const double h = x / steps;
  const auto rate = [&](double v, double sigma) {
    const double by_x = (f - sigma / v) / (v - (1 - sigma) / v);
    return std::pair{by_x, (by_x - sigma) / v};
  };
  for (int k = 0; k < steps; ++k) {
    const auto [v1, s1] = rate(v, sigma);
    const auto [v2, s2] = rate(v + h / 2 * v1, sigma + h / 2 * s1);
    const auto [v3, s3] = rate(v + h / 2 * v2, sigma + h / 2 * s2);
    const auto [v4, s4] = rate(v + h * v3, sigma + h * s3);
    v += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4), sigma += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
  }
  return {v, sigma};
}

}  // namespace

TEST_CASE("A jet fed by flow begins with its bead held, which is nothing placed, and one by pull without") {
  Run<3> by_flow(example("pvp", {"feed flow", "flow rate 60 mL/h"})), by_pull(example("pvp"));
  CHECK(by_flow.scene.jet.held);
  CHECK_FALSE(by_pull.scene.jet.held);
  const Effort effort =
      by_flow.to(0.5 * scales(by_flow.parameters).l_step / inlet_velocity(by_flow.parameters));
  CHECK(effort.placed == 0);
  CHECK(effort.released == 0);
}

TEST_CASE("A release by flow changes neither mass, charge, volume, momentum nor dipole, late or not") {
  const Nozzle<3> nozzle(fed());
  for (double V : {2.0, 2.2}) {
    Jet<3> jet = crooked(V);
    const Sums before = sums(jet, nozzle);
    nozzle.release(jet);
    nozzle.place(jet);
    const Sums after = sums(jet, nozzle);
    constexpr double round_off = 1e-15;
    CHECK(jet.size() == 5);
    CHECK(after.mass == Approx(before.mass).epsilon(round_off));
    CHECK(after.charge == Approx(before.charge).epsilon(round_off));
    CHECK(after.volume == Approx(before.volume).epsilon(round_off));
    CHECK((after.momentum - before.momentum).norm() < 3 * round_off * before.momentum.norm());
    CHECK((after.dipole - before.dipole).norm() < 3 * round_off * before.dipole.norm());
  }
}

TEST_CASE(
    "Both halves of the youngest element keep its stress, radius and strain rate at a release by flow") {
  const Nozzle<3> nozzle(fed());
  Jet<3> jet = crooked(2);
  const Chain<3> before = chain_of<3>(jet, nozzle);
  nozzle.release(jet);
  nozzle.place(jet);
  const Chain<3> after = chain_of<3>(jet, nozzle);
  const auto section = [](const Chain<3>& c, int i) { return c.volume[i] * c.inverse_length[i]; };
  for (int half : {3, 4}) {
    CHECK(after.stress[half] == before.stress[3]);
    CHECK(section(after, half) == Approx(section(before, 3)).epsilon(1e-14));
    CHECK(after.strain_rate[half] == Approx(before.strain_rate[3]).epsilon(1e-14));
  }
}

TEST_CASE("Forces are continuous over a release by flow") {
  Parameters p = fed();
  const Nozzle<3> nozzle(p);
  p.inserting = false;  // forces as they are, without the binding of the youngest bead
  auto f = equations<3>(p, Viscoelastic<3>(1, 2), SurfaceEnergy<3>(0.7, Section{0.1, 1}),
                        SlenderSelfField<3>(2, Section{0.1, 1}), CoulombForce<3>(2, 1 << 30));
  Jet<3> jet = crooked(2);
  const State<3> before = slope(f, jet);
  nozzle.release(jet);
  nozzle.place(jet);
  const State<3> after = slope(f, jet);
  for (Eigen::Index i = 0; i < before.rows(); ++i)
    CHECK((velocity<3>(after, i) - velocity<3>(before, i)).norm() < 1e-13 * velocity<3>(before, i).norm());
}

TEST_CASE("Fed momentum, forces and what the nozzle bears are all that changes a jet's momentum") {
  const Parameters p = fed();
  const Nozzle<3> nozzle(p);
  const double Q = 2, E = 0.3, L_step = 1.2, F_ve = 3;
  for (double V : {1.0, 1.3, 1.9}) {
    const Jet<3> jet = crooked(V);
    auto f = equations<3>(p, Viscoelastic<3>(L_step, F_ve), ElectricField<3>(E), CoulombForce<3>(Q, 1 << 30));
    const State<3> dy = slope(f, jet);
    const Chain<3> c = chain_of<3>(jet, nozzle);
    const int n = c.beads;
    const double s = V - 1;
    const Vec<3> v = c.velocity(n - 1), v_0 = c.nozzle_velocity, a_0 = nozzle.acceleration(jet.t);
    const Vec<3> gain = flow / V * (v - v_0), dv = velocity<3>(dy, n - 1);
    const auto coulomb_at = [&](int at) {
      Vec<3> e = Vec<3>::Zero();
      for (int j = 0; j < c.points(); ++j) {
        const Vec<3> d = (c.point.row(at) - c.point.row(j)).matrix().transpose();
        if (j != at) e += c.point_charge[j] / std::pow(d.norm(), 3) * d;
      }
      return Vec<3>(Q * c.point_charge[at] * e);
    };

    Vec<3> change = flow * (v + v_0) / 2 + s * (dv + a_0) / 2 + a_0 / 2;
    for (int i = 0; i < n; ++i) change += velocity<3>(dy, i);
    // the nozzle moves its own half bead and half of the held one against the forces on them
    const Vec<3> tension = L_step * F_ve * c.stress[n - 1] * V * c.inverse_length[n - 1] *
                           c.tangent.row(n - 1).matrix().transpose();
    const Vec<3> x = Vec<3>::UnitX();
    const Vec<3> held_force = coulomb_at(n) + s * E * x, nozzle_force = coulomb_at(n + 1) + tension;
    const Vec<3> borne = (a_0 + gain) / 2 - nozzle_force + (s * ((dv + a_0) / 2 + gain / 2) - held_force) / 2;
    const Vec<3> by_field = (n + s) * E * x;
    const Vec<3> balance = change - flow * v_0 - by_field - borne;
    CHECK(balance.norm() < 1e-14 * (change.norm() + borne.norm()));
    CHECK(borne.norm() > 0.1);  // not left out by accident
  }
}

TEST_CASE("Over a hundred releases mass and momentum of a jet fed by flow add up to round-off") {
  const std::vector<std::string> flow_of_pvp = {"model slender", "flow rate 60 mL/h",
                                                "collector distance 0.5", "external potential 1"};
  balance<3>(with_tolerance(example("pvp", flow_of_pvp), 1e-4), 1.2e-2);
  balance<1>(with_tolerance(
                 example("straight-jet", {"model slender", "flow rate 0.07", "collector distance 10"}), 1e-4),
             0.11);
}

TEST_CASE("Fed without any force a jet stays a row of equal elements") {
  Parameters p = fed(/*circles*/ false);
  for (const EventRule events : {EventRule::located, EventRule::step}) {
    p.events = events;
    auto f = equations<1>(p, Viscoelastic<1>(1, 2));
    Jet<1> jet = jet_of<1>({bead_at(2, flow), bead_at(1, flow)});
    jet.held = true;
    march_to(20, 0.31, jet, f, p, Scheme::rk4);
    REQUIRE(jet.size() == 10);  // eight elements fed
    for (Eigen::Index i = 0; i < jet.size(); ++i) {
      // exact: uniform motion is integrated exactly, and divided where it is
      CHECK(jet.y(i, 0) == Approx(double(10 - i)).epsilon(1e-13));
      CHECK(jet.y(i, 1) == Approx(flow).epsilon(1e-13));
      CHECK(std::abs(jet.y(i, 2)) < 1e-13);
    }
  }
}

TEST_CASE("A steady jet faster than its elastic waves converges to the solution of its equations") {
  // density, modulus and relaxation time 1; at x = 2 the jet is nearly twice as fast as at the nozzle
  const double v_0 = 1.5, force = 2, x = 2;
  const auto [speed, stress] = steady_jet(v_0, force, x);
  CHECK(speed > 1.5 * v_0);
  std::vector<double> of_speed, of_stress;
  for (int elements : {8, 16, 32}) {
    const double l = x / elements;  // an initial element, hence L_step = 1 in its own units
    Parameters p = plain_parameters();
    p.inserting = true;
    p.feed = Feed::flow;
    p.flow_rate = v_0 / l * pi * p.nozzle_cross * p.nozzle_cross;
    auto f = equations<1>(p, Viscoelastic<1>(1, 1 / (l * l)), ElectricField<1>(force / l));
    Jet<1> jet = jet_of<1>({bead_at(1, v_0 / l)});
    jet.held = true;
    march_to(4 * x / v_0, 0.02 * l, jet, f, p, Scheme::rk4);
    // by a parabola through the three beads around x; every release finds the jet as the last one did
    Eigen::Index i = 0;
    while (jet.y(i, 0) > x / l) ++i;
    const auto at_x = [&](int column, bool of_element) {
      const auto place = [&](Eigen::Index k) {
        return of_element ? (jet.y(k, 0) + jet.y(k + 1, 0)) / 2 : jet.y(k, 0);
      };
      double sum = 0;
      for (Eigen::Index k = i - 1; k <= i + 1; ++k) {
        double weight = 1;
        for (Eigen::Index m = i - 1; m <= i + 1; ++m)
          if (m != k) weight *= (x / l - place(m)) / (place(k) - place(m));
        sum += weight * jet.y(k, column);
      }
      return sum;
    };
    of_speed.push_back(std::abs(at_x(1, false) * l - speed));
    of_stress.push_back(std::abs(at_x(2, true) - stress));
  }
  CAPTURE(of_speed, of_stress, speed, stress);
  for (double order : orders(of_speed)) CHECK(order > 0.8);
  for (double order : orders(of_stress)) CHECK(order > 0.8);
}

TEST_CASE("The derivative of the local slope is exact for an element that is fed") {
  const Parameters p = fed();
  for (double V : {1.0, 1.4, 1.9}) {
    Jet<3> jet = crooked(V);
    auto f = equations<3>(p, Viscoelastic<3>(1.2, 3), ElectricField<3>(0.3),
                          SurfaceEnergy<3>(0.7, Section{0.4, 1}), SlenderSelfField<3>(2, Section{0.4, 1}));
    LocalJacobian<3> J;
    f.differentiate(jet, jet.t, jet.y, J);
    const double step = 1e-6;
    for (Eigen::Index i = 0; i < jet.size(); ++i)
      for (Eigen::Index k = 0; k < own_columns<3>; ++k) {
        CAPTURE(V, i, k);
        State<3> change = State<3>::Zero(jet.size(), own_columns<3>), up, down;
        change(i, k) = 1;
        f(jet, jet.t, jet.y + step * change, up);
        f(jet, jet.t, jet.y - step * change, down);
        // central differences: step^2 and round-off over the step
        CHECK(((up - down) / (2 * step) - answer(J, change)).abs().maxCoeff() < 1e-8);
      }
  }
}

TEST_CASE("While its element grows, the self-field's force across it is that of a row of equal elements") {
  // one bead, radius far below the length: of the bond only the constant of a growing element counts
  const Parameters p = fed(/*circles*/ false);
  auto f = equations<1>(p, SlenderSelfField<1>(1, Section{1e-3, 1}));
  const auto tension = [&](double V) {  // at line charge 1
    Jet<1> jet = jet_of<1>({bead_at(V)});
    jet.held = true;
    jet.last_release = -(V - 1) / flow;
    const State<1> dy = slope(f, jet);
    // unbinds it: velocity of bead and nozzle differ by the flow
    const double s = V - 1;
    return -((1 + s / 4) * dy(0, 1) - s / 4 * flow / V * flow);
  };
  // psi(1) - psi(V) + (V - 1) (psi'(V / 2) - psi'(V))
  const std::pair<double, double> closed[] = {{1.25, 0.20120}, {1.5, 0.18983}, {1.75, 0.10654}};
  for (const auto& [V, lack] : closed) CHECK(tension(V) - tension(1) == Approx(lack).margin(1e-3));
  CHECK(tension(2 - 1e-12) == Approx(tension(1)).epsilon(1e-10));
}

TEST_CASE(
    "A jet fed by flow is the same at one rate and at two, with its local terms solved for, and in steps") {
  const auto jet = [](Parameters p) {
    Run<3> run(p);
    run.to(5e-3);
    return State<3>(run.jet().y);
  };
  const Parameters p = example("pvp", {"model slender", "flow rate 60 mL/h"});
  const auto by = [&](Scheme scheme, Multirate multirate) {
    Parameters q = with_tolerance(p, 1e-8, scheme);
    q.multirate = multirate;
    return jet(q);
  };
  const auto one = by(Scheme::verner6, Multirate::no);
  REQUIRE(one.rows() > 50);
  // tolerance 1e-8 times some 100 events, against beads up to 100 away: 1e-6 at the most
  for (const auto& other : {by(Scheme::verner6, Multirate::automatic), by(Scheme::kencarp5, Multirate::no),
                            jet(with_steps(p, Scheme::rk4, 5e-7))}) {
    REQUIRE(other.rows() == one.rows());
    CHECK((other - one).leftCols<3>().abs().maxCoeff() < 1e-6 * one.leftCols<3>().abs().maxCoeff());
  }
}
