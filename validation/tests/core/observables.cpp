/// Observables where the answer is known: a straight jet that moves uniformly, and windows of any length.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/deck/observable_keys.hpp"
#include "core/observe/output_hdf5.hpp"
#include "core/observe/output_table.hpp"
#include "core/observe/output_xyz.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"
#include "validation/support/scratch_directory.hpp"

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
    if (k == 6) {
      CHECK(r[k][4] == Approx(7).margin(1e-10));
      CHECK(r[k][5] == Approx(0).margin(1e-9));
      CHECK(r[k][6] == Approx(0.015).epsilon(round_off));  // spacing unchanged: radius at the nozzle
      CHECK(r[k][7] == Approx(1).epsilon(round_off));
    } else {  // nothing arrives, and a mean over nothing has no value
      for (std::size_t mean = 4; mean <= 7; ++mean) CHECK(std::isnan(r[k][mean]));
    }
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

TEST_CASE("The mean path of a falling jet is exact, however long the steps") {
  // no charge, and a fluid so thin that its stress, 1e-9 g/(cm s^2), changes nothing: free fall
  Parameters p = uniform_motion();
  p.elastic_modulus = p.viscosity = 1e-9;
  p.gravity = true;
  p.removing = false;
  Run<3> run(p);
  const double window = 0.01, g = 980.665;
  const auto r = recorded<3>(run, {"lp"}, window, 0.03);
  for (std::size_t k = 1; k < r.size(); ++k) {
    const double a = window * double(k - 1), b = a + window;
    // the mean of 0.6 + 7 t + g t^2 / 2 over the window; the trapezoidal rule would be off by g h^2 / 12 =
    // 9e-6
    CHECK(r[k][0] == Approx(0.6 + 7 * (a + b) / 2 + g / 6 * (a * a + a * b + b * b)).epsilon(round_off));
  }
}

TEST_CASE("The mean path of a whipping jet does not depend on how its steps lie in the window") {
  const auto path = [](double tolerance) {
    Run<3> run(with_tolerance(example("pvp"), tolerance));
    return recorded<3>(run, {"lp"}, 1e-3, 4e-3);
  };
  const auto coarse = path(1e-6), fine = path(1e-9);
  // the solution itself is off by up to 6e-7 of the path; the trapezoidal rule over the steps was by 4e-6 to
  // 1.7e-5
  for (std::size_t k = 1; k < fine.size(); ++k) CHECK(coarse[k][0] == Approx(fine[k][0]).epsilon(2e-6));
}

namespace {

/// When beads are placed and released, s.
struct Insertions final : Observer<3> {
  explicit Insertions(double time_unit) : unit(time_unit) {}
  void event(EventKind kind, const Jet<3>& jet) override {
    (kind == EventKind::place ? placed : released).push_back(jet.t * unit);
  }
  double unit;
  std::vector<double> placed, released;
};

}  // namespace

TEST_CASE("A bead counts as charge and mass from the nozzle, and as a bead, when it is placed there") {
  Parameters p = example("pvp");
  p.removing = false;
  Run<3> run(p);
  Insertions insertions(run.unit.time);
  const double window = 5e-6, end = 1.5e-3;
  const auto r = recorded<3>(run, {"t", "n", "f", "l", "curn", "mfn", "chn"}, window, end, {&insertions});
  REQUIRE(insertions.placed.size() > 3);
  REQUIRE(insertions.released[0] > insertions.placed[0] + window);  // they fall into different windows
  const auto within = [](const std::vector<double>& events, double from, double to) {
    return double(std::count_if(events.begin(), events.end(), [&](double t) { return t > from && t <= to; }));
  };
  for (std::size_t k = 1; k < r.size(); ++k) {
    const double t = r[k][0], placed = within(insertions.placed, t - window, t);
    CAPTURE(t, placed);
    CHECK(r[k][6] == Approx(placed * run.unit.charge).epsilon(round_off));
    CHECK(r[k][4] == Approx(placed * run.unit.charge / window).epsilon(1e-9));  // a difference of times
    CHECK(r[k][5] == Approx(placed * run.unit.mass / window).epsilon(1e-9));
    CHECK(r[k][1] == 1 + within(insertions.placed, -1, t));
    CHECK(r[k][3] - r[k][2] == r[k][1]);  // the held bead is one of those between nozzle and farthest bead
  }
}

TEMPLATE_TEST_CASE_SIG("The initial jet has the stress that the deck gives it", "", ((int D), D), 1, 3) {
  Parameters p = uniform_motion();
  p.nozzle_stress = 321;
  Run<D> run(p);
  const auto r = recorded<D>(run, {"st", "sts"}, 0.01, 1e-9);
  CHECK(r[0][0] == Approx(321).epsilon(round_off));
  CHECK(r[0][1] == Approx(321 / p.elastic_modulus).epsilon(round_off));
}

TEST_CASE("A jet whose beads all arrive early has a last row, in which the last of them is counted") {
  Parameters p = uniform_motion();  // the beads arrive after 0.4 and 0.7 cm at 7 cm/s
  Run<3> run(p);
  const auto r = recorded<3>(run, {"t", "chc", "f", "n", "x", "lp"}, 0.03, 0.5);
  REQUIRE(r.size() == 5);  // at 0, 0.03, 0.06, 0.09 and where the second one arrives, at 0.1 s
  CHECK(r[4][0] == Approx(0.1).epsilon(round_off));
  CHECK(r[2][1] + r[4][1] == Approx(2 * run.unit.charge).epsilon(round_off));
  CHECK(r[4][2] == 2);
  CHECK(r[4][3] == 0);
  CHECK(std::isnan(r[4][4]));                                  // there is no farthest bead
  CHECK(r[4][5] == Approx(1 - 7 * 0.005).epsilon(round_off));  // the path in the middle of the last window
}

TEST_CASE("Every key of the documented table has an observable in both dimensions") {
  for (const auto& known : observable_keys) {
    CHECK(observable<1>(known.key) != nullptr);
    CHECK(observable<3>(known.key) != nullptr);
  }
  CHECK_THROWS(observable<1>("velocity"));
}

TEST_CASE(
    "Scaled observables are those in CGS by the scales; charge and mass of a bead are in the fluid's ratio") {
  Run<3> run(example("pvp"));
  const auto last = recorded<3>(run,
                                {"x", "xs", "y", "ys", "z", "zs", "yz", "yzs", "vx", "vxs", "vy", "vys", "vz",
                                 "vzs", "st", "sts", "mass", "q"},
                                1e-3, 2e-3)
                        .back();
  const Scales s = run.unit;
  const double of_pair[] = {s.length,   s.length,   s.length,   s.length,
                            s.velocity, s.velocity, s.velocity, s.stress};
  for (std::size_t k = 0; k < std::size(of_pair); ++k) {
    CAPTURE(k);
    CHECK(last[2 * k] != 0);
    CHECK(last[2 * k] == Approx(last[2 * k + 1] * of_pair[k]).epsilon(round_off));
  }
  CHECK(last[17] / last[16] ==
        Approx(run.parameters.density_charge / run.parameters.density_mass).epsilon(round_off));
}

TEST_CASE("Rows stand at exactly the asked times, whatever the steps") {
  Run<1> run(with_steps(example("single-bead"), Scheme::heun, 7e-5));
  const auto r = recorded<1>(run, {"t"}, 1e-3, 0.05);
  REQUIRE(r.size() == 51);
  for (std::size_t k = 0; k < r.size(); ++k) CHECK(r[k][0] == Approx(1e-3 * double(k)).epsilon(1e-14));
}

TEST_CASE("print xyz rescale stretches all coordinates of a frame") {
  const ScratchDirectory place;
  Run<3> run(example("pvp"));
  const auto frame = [&](double rescale, const char* file) {
    XyzTrajectory<3> trajectory({run.scene.nozzle, run.unit, 1, 2, rescale, "treejet"},
                                OutputFile(place.path / file, OutputFile::Existing::keep));
    trajectory.start(run.jet());
    trajectory.finish(run.jet());
    std::ifstream in(place.path / file);
    std::vector<double> r;
    std::string line;
    std::getline(in, line), std::getline(in, line);
    for (std::string element; in >> element;)
      for (int k = 0; k < 3; ++k) in >> r.emplace_back();
    return r;
  };
  const auto plain = frame(1, "plain"), doubled = frame(2, "doubled");
  REQUIRE(plain.size() == 6);
  REQUIRE(plain[0] == 0.02);  // the bead, and the nozzle on its circle
  for (std::size_t k = 0; k < plain.size(); ++k) CHECK(doubled[k] == 2 * plain[k]);
}

TEST_CASE("What has no value is nan in statdat.dat") {
  const ScratchDirectory place;
  {
    StatFile table(OutputFile(place.path / "statdat.dat", OutputFile::Existing::keep), {"t", "vc"}, {});
    table.row({0.5, std::nan("")});
    table.finish();
  }
  std::ifstream in(place.path / "statdat.dat");
  std::string line, last;
  while (std::getline(in, line)) last = line;
  double t = 0;
  std::string vc;
  std::istringstream(last) >> t >> vc;
  CHECK(t == 0.5);
  CHECK(vc == "nan");
}

TEST_CASE("Keys that tell the wall clock stay out of files that are a function of the run") {
  std::vector<std::string> keys;
  for (const auto& known : observable_keys) keys.emplace_back(known.key);
  const auto kept = reproducible_keys(keys);
  for (const char* key : {"cpu", "cpue", "cpur"}) CHECK(std::count(kept.begin(), kept.end(), key) == 0);
  CHECK(kept.size() == keys.size() - 3);
}

TEST_CASE("Means over arrivals weigh by mass, and what one bead does not bring the other does") {
  // both arrive in one window, at 7 cm/s; the second is three times as heavy and comes from a shorter element
  Parameters p = uniform_motion();
  Run<3> run(p);
  run.scene.jet.mass << 1, 3;
  const auto r = recorded<3>(run, {"vc", "mfc", "chc"}, 0.2, 0.2);
  REQUIRE(r.size() == 2);
  CHECK(r[1][0] == Approx(7).margin(1e-9));
  CHECK(r[1][1] == Approx(4 * run.unit.mass / 0.1).epsilon(1e-9));  // the run ends with the last arrival
  CHECK(r[1][2] == Approx(2 * run.unit.charge).epsilon(round_off));
}

TEST_CASE("Charge is fed and lands without steps, and as much as by whole beads in the end") {
  Parameters p = uniform_motion();
  p.inserting = true;
  p.density_charge = 1e-6;  // counted, and too small to push
  Run<3> run(p);
  const double window = 1e-3;  // a bead is 43 windows long
  const auto r = recorded<3>(run, {"fcn", "fcc"}, window, 0.3);
  // l_step 0.3 cm at 7 cm/s: beads are fed at 7 / 0.3 a second from the start, and land so from the second on
  for (std::size_t k = 1; k < r.size(); ++k) {
    CAPTURE(k);
    CHECK(r[k][0] == Approx(7 / 0.3 * run.unit.charge).epsilon(1e-6));
    if (double(k) * window > 0.06) CHECK(r[k][1] == Approx(7 / 0.3 * run.unit.charge).epsilon(1e-6));
  }
}

TEST_CASE("A nozzle that inserts nothing feeds no current, not even as the jet leaves it") {
  Parameters p = uniform_motion();
  p.density_charge = 1e-6;  // counted, and too small to push
  Run<3> run(p);
  const auto r = recorded<3>(run, {"fcn", "curn"}, 1e-2, 0.3);
  REQUIRE(r.size() > 10);
  for (const auto& row : r) CHECK((row[0] == 0 && row[1] == 0));
}

TEST_CASE("The largest error of the forces is not their mean one") {
  Run<3> run(example("pvp"));
  FieldErrorReport forces;
  forces.method = "tree", forces.l2 = 1e-6, forces.max = 3e-5;
  auto setting = Recorder<3>::setting(run.parameters, run.scene.nozzle, run.scene.collector, &forces, {});
  Recorder<3> recorder(setting);
  struct Keep final : RowSink {
    void row(const std::vector<double>& values) override { last = values; }
    void remark(const std::string&) override { ++remarks; }
    std::vector<double> last;
    int remarks = 0;
  };
  const auto kept = std::make_shared<Keep>();
  recorder.add({"ferr", "ferrmax"}, kept);
  recorder.start(run.jet());
  CHECK(kept->last == std::vector<double>{1e-6, 3e-5});
  Jet<3> later = run.jet();
  later.t = setting.interval;
  recorder.finish(later);
  CHECK(kept->remarks == 1);  // the method has not changed since
}

TEST_CASE("The aperture is the full angle of the cone that the oldest bead is on") {
  Run<3> run(uniform_motion());
  run.scene.jet.y.row(0).head<3>() << 0.3, 0.1, std::sqrt(0.09 - 0.01);  // as far off the axis as along it
  const auto r = recorded<3>(run, {"angl"}, 1e-9, 1e-9);
  CHECK(r[0][0] == Approx(90).epsilon(round_off));
}

TEST_CASE("The path of a window ends at the nozzle where it is then") {
  Parameters p = plain_parameters();
  p.perturb = true;
  p.perturb_frequency = 2;
  p.perturb_amplitude = 0.3;
  const Nozzle<3> nozzle(p);
  const Collector collector(p);
  Statistics<3> statistics(nozzle, collector);
  statistics.follow_path();
  Jet<3> jet = jet_of<3>({Bead<3>({1, 0.3, 0})});
  jet.slope.setZero(1, own_columns<3>);
  SolutionPoint<3> end = jet;
  end.t = 0.2;
  statistics.begin_window(0);
  statistics.integrate(DenseOutput<3>(jet, end), end.t);
  // a bead at rest beside the place where the nozzle began: the chord of the angle 2 t, by many trapezoids
  double sum = 0;
  constexpr int n = 1000;
  for (int k = 0; k <= n; ++k)
    sum += (k % n == 0 ? 0.5 : 1) * std::sqrt(1 + 2 * 0.09 * (1 - std::cos(2 * 0.2 * k / n)));
  CHECK(statistics.window().path_length == Approx(0.2 * sum / n).epsilon(1e-6));  // two of Gauss's points
}

TEST_CASE(
    "A bead that has dried arrives with what is left of its mass, the only one with the held one's volume") {
  Parameters p = plain_parameters();
  p.inserting = true;
  p.feed = Feed::flow;
  p.flow_rate = 0.01;
  const Columns columns = {Column{.name = "solvent", .unit = "1", .at_birth = 0.9, .volume = 1}};
  const Nozzle<3> nozzle(p, columns);
  const Collector collector(p);
  Statistics<3> statistics(nozzle, collector, {{}, columns});
  const double half_is_left = 0.4;
  Jet<3> jet = jet_of<3>({with_added<3>({Vec<3>(2, 0, 0), Vec<3>(5, 0, 0), 0, 1.5}, half_is_left)});
  jet.held = true;
  jet.t = 0.6 / nozzle.feed().flow();
  statistics.event(EventKind::removal, jet);
  CHECK(statistics.window().mass_out == Approx(1.5 * 0.5).epsilon(round_off));
  // a^2 / a_0^2 = V l_step / l : 1.6 of volume, half of it left, over twice the length of an element
  CHECK(statistics.window().radius == Approx(1.5 * std::sqrt(1.6 * 0.5 / 2)).epsilon(round_off));
}
