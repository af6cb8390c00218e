/// Evaporation: how fast a jet dries, where it ends, and that no mass is lost.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "forces/terms/evaporation.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

Parameters drying(EvaporationModel model, double polymer = 0.06) {
  Parameters p = example("pvp");
  p.evaporation = true;
  p.evaporation_model = model;
  p.polymer_fraction = polymer;
  return p;
}

/// What is left of the volume of an element of length `cm` that flies at `speed` cm/s for some seconds,
/// without forces.
double left_after(const Parameters& p, double cm, double speed, double seconds, int steps) {
  const Scales s = scales(p);
  const Evaporation evaporation(p);
  const Columns columns = {SolventColumn<1>(evaporation).column()};
  const Nozzle<1> nozzle(p, columns);
  EquationsOfMotion<1> f(nozzle, std::make_unique<DryingStress<1>>(evaporation, /*relaxes*/ true), {},
                         nullptr, Threads{1});
  f.add_column(std::make_unique<SolventColumn<1>>(evaporation));
  Jet<1> jet;
  jet.y = State<1>(0, own_columns<1> + 1);
  for (double x : {cm + 0.1, 0.1}) {
    Bead<1> bead{Vec<1>(x / s.length), Vec<1>(speed / s.velocity)};
    // the element up to the nozzle only grows: it is dry
    bead.added = {jet.size() == 0 ? columns[0].at_birth : 0};
    append(jet, bead);
  }
  Parameters stepped = with_steps(p, Scheme::rk4, seconds / steps);
  stepped.inserting = stepped.removing = false;
  const Nozzle<1> end(stepped, columns);
  const Collector collector(stepped);
  Integration<1>(stepped, {jet, f, end, collector, undivided<1>, columns}).march.to(seconds / s.time);
  return evaporation.remaining(jet.y(0, own_columns<1>));
}

double closed_answer(const Parameters& p, double cm, double speed, double seconds, double delta) {
  const double D = p.vapour_diffusivity.value_or(water_diffusivity(p.temperature)),
               nu = p.drying_air_viscosity;
  const double u = std::hypot(speed, 1.0);  // air is never stiller than 1 cm/s
  const double K = 0.495 * D * std::cbrt(2 * u / nu) * std::sqrt(nu / D) * delta;
  const double a = p.nozzle_cross * std::sqrt(scales(p).l_step / cm);
  // d(a^2)/dt = - K a^(1/3):  a^(5/3) falls linearly
  const double a53 = std::pow(a, 5. / 3) - 5. / 6 * K * seconds;
  return std::pow(a53, 6. / 5) / (a * a);
}

}  // namespace

TEST_CASE(
    "The radius of an element that flies at one speed through dry air falls as a^(5/3) linearly in time") {
  const Parameters p = drying(EvaporationModel::jetspin);
  const double delta = vapour_pressure(SolventName::water, p.temperature) / 101325;
  for (double seconds : {1e-5, 3.5e-5}) {
    const double left = closed_answer(p, 3, 1500, seconds, delta);
    REQUIRE(left > 0.1);
    // classical Runge-Kutta with 400 steps of at most a hundredth of it
    CHECK(left_after(p, 3, 1500, seconds, 400) == Approx(left).epsilon(1e-9));
  }
}

TEST_CASE("JETSPIN's law dries water some 1330 times faster than the vapour that air can hold lets it") {
  Parameters water = drying(EvaporationModel::jetspin);
  water.density_mass = 1;
  const double jetspin = Evaporation(water).driving(0.94);
  water.evaporation_model = EvaporationModel::vapour;
  const Evaporation vapour(water);
  // the activity of water over 6 % polymer, by Flory and Huggins
  const double activity = 0.94 * std::exp(0.06 + 0.5 * 0.06 * 0.06);
  CHECK(jetspin * activity / vapour.driving(0.94) == Approx(1335).epsilon(1e-3));
}

TEST_CASE("A jet dries until it is in balance with humid air, and never loses more than its solvent") {
  Parameters p = drying(EvaporationModel::vapour);
  p.humidity = 0.4;
  const double c = 0.06 / left_after(p, 3, 1, 50, 40000);
  // at balance: to what is left of the approach after so long
  CHECK((1 - c) * std::exp(c + 0.5 * c * c) == Approx(0.4).epsilon(1e-8));
  p.humidity = 0;
  const double left = left_after(p, 3, 1500, 20, 20000);
  CHECK(left >= 0.06);
  CHECK(left < 0.0601);
  const Evaporation dry(drying(EvaporationModel::vapour));
  CHECK(dry.driving(0) == 0);
  CHECK(dry.driving(-1e-3) < 0);  // what a step overshoots comes back
}

TEST_CASE(
    "JETSPIN's law stops at a concentration of 0.9, with the viscosity and modulus that its tests record") {
  const Parameters p = drying(EvaporationModel::jetspin);
  const Evaporation e(p);
  CHECK(e.driving(0.06 / 0.9 - 0.06) == 0);
  CHECK(e.driving(0.06 / 0.9 - 0.06 + 1e-9) > 0);
  CHECK(e.viscosity_ratio(0.9) == Approx(43.9783350).epsilon(1e-8));
  CHECK(e.relaxation_ratio(0.9) == Approx(15).epsilon(1e-12));
  CHECK(e.viscosity_ratio(0.9) / e.relaxation_ratio(0.9) == Approx(2.93188900).epsilon(1e-8));
  CHECK(water_diffusivity(293.15) == Approx(0.242001758).epsilon(1e-8));
  CHECK(vapour_pressure(SolventName::water, 293.15) == Approx(2337).epsilon(1e-3));
  // the step that would go beyond ends there
  CHECK(left_after(p, 3, 1500, 1e-4, 20000) == Approx(0.06 / 0.9).epsilon(1e-14));
}

TEST_CASE("A dry Kelvin-Voigt element has spring and dashpot stiffer by JETSPIN's recorded ratios") {
  Parameters p = drying(EvaporationModel::jetspin);
  p.kvfluid = true;
  p.inserting = p.perturb = p.gravity = false;
  p.density_charge = p.surface_tension = 0;
  Run<3> run(p);
  Jet<3>& jet = run.scene.jet;
  REQUIRE(jet.size() == 1);
  jet.y(0, velocity_column<3>) = 2;
  const auto slope_at = [&](double concentration) {
    jet.y(0, own_columns<3>) = 0.06 / concentration - 0.06;
    State<3> slope;
    (*run.scene.motion)(jet, 0, jet.y, slope);
    return slope;
  };
  const State<3> fresh = slope_at(0.06), dry = slope_at(0.9);
  CHECK(dry(0, stress_column<3>) / fresh(0, stress_column<3>) == Approx(2.93188900).epsilon(1e-8));
  // tension goes with viscosity and section; the mass falls with the section
  CHECK(dry(0, velocity_column<3>) / fresh(0, velocity_column<3>) == Approx(43.9783350).epsilon(1e-8));
}

TEST_CASE(
    "What arrives dry is told as such at the collector, and its means are those of the beads that arrive") {
  Parameters p = with_tolerance(drying(EvaporationModel::jetspin, 0.5), 1e-5);
  p.collector_distance = 0.4;
  p.vapour_diffusivity = 1e5;  // dry long before it arrives
  p.final_time = 1.2e-3;
  const std::vector<std::string> keys = {"evrc", "visc", "gc",  "emfc", "mfc",
                                         "vc",   "vx",   "vol", "volr", "rc"};
  Run<3> run(p);
  const auto rows = recorded(run, keys, 2e-4, p.final_time);
  const std::vector<double>& last = rows.back();
  REQUIRE(std::isfinite(last[0]));
  const double left = 0.5 / 0.9;
  // all that arrives has the concentration at which drying stops, to round-off
  CHECK(last[0] == Approx(1 - left).epsilon(1e-12));
  CHECK(last[1] == Approx(20 * std::pow(10, 7 * (std::pow(0.9, 0.1) - std::pow(0.5, 0.1)))).epsilon(1e-12));
  CHECK(last[2] == Approx(last[1] / 20 * 50000 / 1.8).epsilon(1e-12));
  CHECK(last[3] / (last[3] + last[4]) == Approx(last[0]).epsilon(1e-12));  // the same sums
  // the farthest bead is the next to arrive, a tenth slower
  CHECK(last[5] == Approx(last[6]).epsilon(0.2));
  CHECK(last[7] == Approx(std::numbers::pi * 0.005 * 0.005 * 0.02 * (1 - last[8])).epsilon(1e-12));
}

TEST_CASE("A bead that is as near to dry as times can tell apart is dry, and the run goes on") {
  struct Count final : Observer<3> {
    void segment(const Jet<3>&, const DenseOutput<3>&) override {
      if (++segments > 100) throw std::runtime_error("the march does not get on");
    }
    int segments = 0;
  } count;
  Parameters p = with_steps(drying(EvaporationModel::jetspin, 0.06), Scheme::heun, 1e-6);
  p.inserting = p.removing = p.perturb = false;
  Run<3> run(p);
  Jet<3>& jet = run.scene.jet;
  const Column& solvent = run.scene.columns.at(0);
  jet.t = 1e9 / run.unit.time * 1e-6;  // where times are farther apart than events are told
  jet.y(0, own_columns<3>) = *solvent.end + 1e-3 * solvent.small;
  State<3> slope;
  (*run.scene.motion)(jet, jet.t, jet.y, slope);
  const double next_time = std::nextafter(jet.t, 2 * jet.t) - jet.t;
  // dry within a third of the time between two numbers, and farther from it than round-off of the column
  jet.y(0, own_columns<3>) = *solvent.end - slope(0, own_columns<3>) * next_time / 3;
  REQUIRE(jet.y(0, own_columns<3>) > *solvent.end + 1e-12 * solvent.small);
  run.to(jet.t * run.unit.time + 5e-6, {&count});
  CHECK(jet.y(0, own_columns<3>) == *solvent.end);
  CHECK(count.segments >= 5);
}

TEST_CASE("Without evaporation what is told of it is the fluid of the deck") {
  Parameters p = with_tolerance(example("pvp"), 1e-5);
  p.collector_distance = 0.4;
  p.final_time = 1e-3;
  Run<3> run(p);
  const std::vector<double> last =
      recorded(run, {"evrc", "visc", "gc", "emfc", "volr"}, 2e-4, p.final_time).back();
  CHECK(last[0] == 0);
  CHECK(last[1] == Approx(20).epsilon(1e-12));
  CHECK(last[2] == Approx(50000).epsilon(1e-12));
  CHECK(last[3] == 0);
  CHECK(last[4] == 0);
}

TEST_CASE("Vapour pressures at 25 degrees are those of tables") {
  const double T = 298.15;
  // kPa, CRC Handbook; DMF's equation is for 30 to 90 degrees
  CHECK(vapour_pressure(SolventName::water, T) == Approx(3169).epsilon(2e-3));
  CHECK(vapour_pressure(SolventName::ethanol, T) == Approx(7870).epsilon(0.01));
  CHECK(vapour_pressure(SolventName::acetone, T) == Approx(30800).epsilon(0.02));
  CHECK(vapour_pressure(SolventName::chloroform, T) == Approx(26200).epsilon(0.02));
  CHECK(vapour_pressure(SolventName::dmf, T) == Approx(500).epsilon(0.1));
}

TEST_CASE("In air as humid as it can be nothing evaporates, to the bit") {
  Parameters p = with_tolerance(drying(EvaporationModel::jetspin), 1e-5);
  p.humidity = 1;
  Run<3> humid(p);
  p.evaporation = false;
  Run<3> without(p);
  humid.to(1e-3);
  without.to(1e-3);
  REQUIRE(humid.beads() == without.beads());
  CHECK((humid.jet().y.leftCols(own_columns<3>) == without.jet().y).all());
}

TEST_CASE("What a drying jet has lost is what the rates of evaporation add up to") {
  Parameters p = with_tolerance(drying(EvaporationModel::jetspin, 0.4), 1e-7);
  Run<3> run(p);
  const double interval = 5e-6 / run.unit.time;
  Snapshots<3> snapshots(interval);
  const double end = 1e-3;
  run.to(end, {&snapshots});
  // the evaporated mass so far is that of all beads let go less what is left of them
  const Evaporation e(p);
  const auto evaporated = [&](const Jet<3>& jet) {
    double sum = 0;
    for (Eigen::Index i = 0; i < jet.size(); ++i) sum += 1 - e.remaining(jet.y(i, own_columns<3>));
    return sum;
  };
  double integral = 0, before = 0;
  for (std::size_t k = 0; k < snapshots.jets.size(); ++k) {
    const Jet<3>& jet = snapshots.jets[k];
    State<3> slope;
    (*run.scene.motion)(jet, jet.t, jet.y, slope);
    const double rate = -slope.col(own_columns<3>).sum();
    if (k > 0) integral += interval * (before + rate) / 2;
    before = rate;
  }
  CHECK(evaporated(run.jet()) > 0.1);
  // trapezoids over 200 intervals, in one of 20 of which a bead is let go
  CHECK(evaporated(run.jet()) == Approx(integral).epsilon(0.01));
}

TEST_CASE("A drying jet moves the same by the scheme that solves for its local terms") {
  const auto x = [](Scheme scheme) {
    Parameters p = with_tolerance(drying(EvaporationModel::jetspin, 0.3), 1e-7, scheme);
    Run<3> run(p);
    run.to(1e-3);
    return run.x();
  };
  // beads whose solvent is gone have a kink there, which a step meets as its tolerance lets it
  CHECK(x(Scheme::kencarp5) == Approx(x(Scheme::verner6)).epsilon(1e-3));
}

TEST_CASE("The water in the air slows water, and no other solvent") {
  const auto driving = [](SolventName solvent, double humidity) {
    Parameters p = drying(EvaporationModel::vapour);
    p.solvent = solvent;
    p.humidity = humidity;
    p.vapour_diffusivity = 0.1;
    const Evaporation e(p);
    return e.driving(e.solvent_at_birth());
  };
  CHECK(driving(SolventName::water, 0.5) < 0.6 * driving(SolventName::water, 0));
  CHECK(driving(SolventName::acetone, 0.5) == driving(SolventName::acetone, 0));
}

TEST_CASE("Flory and Huggins' activity drives the drying, the fluid thickens and relaxes by powers") {
  Parameters p = drying(EvaporationModel::vapour, 0.2);
  p.flory_chi = 0.4;
  p.viscosity_b = 3, p.viscosity_m = 0.5, p.relaxation_t = 1.5;
  p.vapour_density = 0.01 * p.density_mass;
  const Evaporation e(p);
  // phi = 0.2 / (0.2 + 0.2): a = (1 - phi) exp(phi + chi phi^2)
  CHECK(e.driving(0.2) == Approx(0.01 * 0.5 * std::exp(0.5 + 0.4 * 0.25)).epsilon(1e-14));
  CHECK(e.viscosity_ratio(0.81) == Approx(std::pow(10, 3 * (0.9 - std::sqrt(0.2)))).epsilon(1e-14));
  CHECK(e.relaxation_ratio(0.4) == Approx(std::pow(2, 1.5)).epsilon(1e-14));
}

TEST_CASE(
    "A drying Maxwell element relaxes by its own time, and a scheme that solves for it knows; a spring does "
    "not") {
  const Parameters p = drying(EvaporationModel::jetspin);
  const Evaporation evaporation(p);
  const Columns columns = {SolventColumn<1>(evaporation).column()};
  const Nozzle<1> nozzle(p, columns);
  const double relaxation = evaporation.relaxation_ratio(0.5);
  REQUIRE(std::abs(relaxation - 1) > 0.1);  // so that the fluid at the nozzle would be another one
  Jet<1> jet;
  jet.y = State<1>(0, own_columns<1> + 1);
  Bead<1> bead{Vec<1>(2), Vec<1>(0), 3};
  bead.added = {0.06 / 0.5 - 0.06};
  append(jet, bead);
  for (const bool relaxes : {true, false}) {
    DryingStress<1> law(evaporation, relaxes);
    EquationsOfMotion<1> f(nozzle, std::make_unique<DryingStress<1>>(law), {}, nullptr, Threads{1});
    f.add_column(std::make_unique<SolventColumn<1>>(evaporation));
    const auto stress_rate = [&](double stress) {
      jet.y(0, stress_column<1>) = stress;
      State<1> slope;
      f(jet, 0, jet.y, slope);
      return slope(0, stress_column<1>);
    };
    const double expected = relaxes ? -1 / relaxation : 0;
    CHECK(stress_rate(3) - stress_rate(2) ==
          Approx(expected).epsilon(1e-12));  // linear: no more than round-off
    Chain<1> chain = chain_of(jet, nozzle);
    CHECK(law.derivative(chain, 0).by_state(0, 0) == Approx(expected).epsilon(1e-14));
  }
}

TEST_CASE("A jet that goes with the wind dries as one at rest in still air") {
  Parameters p = drying(EvaporationModel::vapour);
  p.inserting = p.removing = p.perturb = false;
  const auto rate = [&](double speed, double wind) {
    Parameters q = p;
    q.airdrag = wind > 0;
    q.air_velocity = wind;
    q.nozzle_velocity = speed;
    q.points = 2;
    Run<3> run(q);
    State<3> slope;
    (*run.scene.motion)(run.jet(), 0, run.jet().y, slope);
    return slope(0, own_columns<3>);
  };
  // drag counts from wind on, speed through the air alone does for drying
  CHECK(std::abs(rate(50, 50)) < 0.9 * std::abs(rate(50, 0)));
}

TEST_CASE("An element dries by the mean speed of its two ends") {
  const Parameters p = drying(EvaporationModel::vapour);
  const Evaporation evaporation(p);
  const Columns columns = {SolventColumn<1>(evaporation).column()};
  EquationsOfMotion<1> f(Nozzle<1>(p, columns), std::make_unique<DryingStress<1>>(evaporation, true), {},
                         nullptr, Threads{1});
  f.add_column(std::make_unique<SolventColumn<1>>(evaporation));
  const auto rate = [&](double below, double above) {
    Jet<1> jet;
    jet.y = State<1>(0, own_columns<1> + 1);
    for (const auto& [x, v] : {std::pair{2., below}, std::pair{1., above}}) {
      Bead<1> bead{Vec<1>(x), Vec<1>(v)};
      bead.added = {columns[0].at_birth};
      append(jet, bead);
    }
    State<1> slope;
    f(jet, 0, jet.y, slope);
    return slope(0, own_columns<1>);
  };
  CHECK(rate(900, 100) == Approx(rate(500, 500)).epsilon(1e-14));
}

TEST_CASE("The instant at which an element has dried is located: a scheme keeps its order over it") {
  const auto state_after = [](int steps) {
    Parameters p = drying(EvaporationModel::jetspin, 0.5);
    p.inserting = p.removing = p.perturb = false;
    p.points = 3;
    p.initial_length = 0.06;
    p.vapour_diffusivity = 500;  // dry in the middle of the run, where steps have become regular
    const double end = 1e-4;
    p = with_steps(p, Scheme::rk4, end / steps);
    Run<3> run(p);
    run.to(end);
    // all three are dry, to the last bit, at instants of their own
    for (Eigen::Index i = 0; i < 3; ++i) CHECK(run.jet().y(i, own_columns<3>) == 0.5 / 0.9 - 0.5);
    return run.jet().y;
  };
  const State<3> coarse = state_after(40), middle = state_after(80), fine = state_after(160);
  const double first = (coarse - middle).abs().maxCoeff(), second = (middle - fine).abs().maxCoeff();
  CAPTURE(first, second);
  CHECK(second > 1e-13);       // above round-off
  CHECK(first > 10 * second);  // order 4 gives 16; a kink within steps gives 4
}
