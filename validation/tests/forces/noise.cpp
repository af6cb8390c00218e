/// Noise: the generator, the statistics of what it drives, and the orders of both ways of stepping it.

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/base/philox.hpp"
#include "core/jet/stiffness.hpp"
#include "forces/terms/random_force.hpp"
#include "forces/terms/viscoelastic.hpp"
#include "integrators/schemes/sra1.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

struct Moments {
  double mean, variance;
};

/// Of all components of all velocities, none of which knows of another.
Moments moments(const State<3>& y) {
  const auto v = y.middleCols<3>(velocity_column<3>);
  const double mean = v.mean();
  return {mean, (v - mean).square().sum() / double(v.size() - 1)};
}

/// So many free beads, all at the same velocity and too far apart to meet.
Jet<3> free_beads(int n, double v) {
  Jet<3> jet;
  jet.y = State<3>::Zero(n, own_columns<3>);
  jet.y.col(0) = Eigen::ArrayXd::LinSpaced(n, 100. * n, 100);
  jet.y.middleCols<3>(velocity_column<3>) = v;
  jet.mass = jet.charge = jet.volume = Eigen::ArrayXd::Ones(n);
  return jet;
}

/// Steps of SRA1 from where the jet is.
void white_steps(const Noise& noise, EquationsOfMotion<3>& f, Jet<3>& jet, double h, int steps) {
  Sra1<3> scheme(noise, wiener_path(noise.seed));
  State<3> next;
  for (int k = 0; k < steps; ++k) {
    jet.slope = slope(f, jet);
    scheme.step(f, jet, jet, h, next);
    jet.t += h;
    jet.y = next;
  }
}

/// A path of many components known at fine steps, whose increments over longer ones are sums.
class FinePath {
 public:
  FinePath(double h, int steps) : h_(h) {
    for (int bead = 0; bead < beads; ++bead)
      for (int k = 0; k < 3; ++k)
        for (int step = 0; step < steps; ++step) {
          const auto [u1, u2] = normal_pair(7, static_cast<std::uint32_t>(k), bead, std::uint64_t(step));
          increments_[{bead, k}].push_back(
              {std::sqrt(h) * u1, h * std::sqrt(h) / 2 * (u1 + u2 / std::numbers::sqrt3)});
        }
  }

  /// dW and Z over the step of length h from t:  Z = sum of Z_j + h_j (W_j - W(t)) .
  std::array<double, 2> over(std::int64_t bead, int k, double t, double h) const {
    const auto first = std::size_t(std::lround(t / h_)), count = std::size_t(std::lround(h / h_));
    double W = 0, Z = 0;
    for (std::size_t j = first; j < first + count; ++j) {
      const auto& [dW, dZ] = increments_.at({int(bead), k})[j];
      Z += dZ + h_ * W;
      W += dW;
    }
    return {W, Z};
  }

  static constexpr int beads = 3;

 private:
  double h_;
  std::map<std::pair<int, int>, std::vector<std::array<double, 2>>> increments_;
};

}  // namespace

TEST_CASE("Philox gives the words of its authors' known answers") {
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  constexpr std::uint32_t all = 0xffffffff;
  CHECK(philox({all, all, all, all}, {all, all}) ==
        PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("Normal numbers have the moments of the normal distribution, and pairs do not know of each other") {
  constexpr int n = 100000;
  double sum = 0, square = 0, fourth = 0, product = 0;
  for (int i = 0; i < n; ++i) {
    const auto [a, b] = normal_pair(1, 0, i, 5);
    sum += a + b;
    square += a * a + b * b;
    fourth += a * a * a * a + b * b * b * b;
    product += a * b;
  }
  // three standard errors: the variances of x, x^2, x^4 and a b are 1, 2, 96 and 1
  CHECK(std::abs(sum / (2 * n)) < 3 / std::sqrt(2. * n));
  CHECK(std::abs(square / (2 * n) - 1) < 3 * std::sqrt(2 / (2. * n)));
  CHECK(std::abs(fourth / (2 * n) - 3) < 3 * std::sqrt(96 / (2. * n)));
  CHECK(std::abs(product / n) < 3 / std::sqrt(double(n)));
  CHECK(normal_pair(1, 0, 3, 5) != normal_pair(2, 0, 3, 5));
  CHECK(normal_pair(1, 0, 3, 5) != normal_pair(1, 0, 5, 3));
}

TEST_CASE("Beads with friction and noise are an Ornstein-Uhlenbeck process, by either way of stepping") {
  constexpr int n = 4096;
  const double v0 = 3, g = 0.8, D = 0.5, t = 1.3;
  Noise noise;
  noise.diffusivity = D;
  noise.friction = g;
  noise.interval = 0.05;
  noise.seed = 317;
  const double mean = v0 * std::exp(-g * t), variance = D / g * (1 - std::exp(-2 * g * t));
  const double count = 3 * n;
  const auto check = [&](const State<3>& y) {
    const Moments m = moments(y);
    // three standard errors; a clock of interval Delta changes the variance by (g Delta)^2 / 12 = 1e-4 of it
    CHECK(m.mean == Approx(mean).margin(3 * std::sqrt(variance / count)));
    CHECK(m.variance == Approx(variance).margin(3 * variance * std::sqrt(2 / count)));
  };
  SECTION("by a random force on a clock, with a scheme that knows nothing of it") {
    for (const Scheme scheme : {Scheme::rk4, Scheme::kencarp5}) {
      auto f = equations<3>(plain_parameters(), Friction<3>(g), RandomForce<3>(noise));
      auto jet = free_beads(n, v0);
      march_to<3>(t, 0.1, jet, f, plain_parameters(), scheme);
      check(jet.y);
    }
  }
  SECTION("by white noise") {
    auto f = equations<3>(plain_parameters(), Friction<3>(g));
    auto jet = free_beads(n, v0);
    constexpr int steps = 26;
    white_steps(noise, f, jet, t / steps, steps);
    check(jet.y);
  }
}

TEST_CASE(
    "White noise by SRA1 gives beads with friction the variance that is known of its steps, of weak order "
    "2") {
  // A step of x = g h takes v to (1 - x + x^2/2) v and adds  b (dW - x Z / h)  of variance  2 D h (1 - x +
  // x^2/3) ; where all is forgotten  variance g / D = (1 - x + x^2/3) / (1 - x + x^2/2 - x^3/8) = 1 - x^2/6 +
  // O(x^3)
  const auto on_paper = [](double x) { return (1 - x + x * x / 3) / (1 - x + x * x / 2 - x * x * x / 8); };
  CHECK((1 - on_paper(0.02)) / (1 - on_paper(0.01)) == Approx(4).epsilon(0.02));  // its x^3 is 1 % of x^2
  const double g = 0.8, D = 0.5;
  Noise noise;
  noise.diffusivity = D;
  noise.friction = g;
  noise.seed = 11;
  for (const double x : {1.0, 0.5}) {
    auto f = equations<3>(plain_parameters(), Friction<3>(g));
    auto jet = free_beads(4096, 0);
    constexpr int samples = 12;
    double sum = 0;
    for (int k = 0; k < samples; ++k) {
      white_steps(noise, f, jet, x / g, 10);  // after which a hundredth or less of v is left
      sum += moments(jet.y).variance * g / D;
    }
    // three standard errors
    CHECK(sum / samples == Approx(on_paper(x)).epsilon(3 * std::sqrt(2. / (3 * 4096 * samples))));
    CHECK(on_paper(x) < 1 - x * x / 25);  // which is far from the variance of the process
  }
}

TEST_CASE(
    "The random force over whole intervals is a normal push of variance b^2 t, to the bit by any scheme") {
  Noise noise;
  noise.diffusivity = 0.5;
  noise.interval = 0.25;
  const auto pushed = [&](Scheme scheme, double dt) {
    auto f = equations<3>(plain_parameters(), RandomForce<3>(noise));
    auto jet = free_beads(2000, 0);
    march_to<3>(1, dt, jet, f, plain_parameters(), scheme);
    return jet.y;
  };
  const State<3> v = pushed(Scheme::euler, 0.25);
  CHECK(moments(v).variance == Approx(1).margin(3 * std::sqrt(2. / 6000)));
  // steps of 0.1 are cut by the clock; Verner's weights of 176 leave 1e-13 of round-off
  for (const Scheme scheme : {Scheme::heun, Scheme::verner6})
    CHECK((pushed(scheme, 0.1) - v).middleCols<3>(3).abs().maxCoeff() < 1e-12);
}

namespace {

using Velocities = Eigen::Array<double, Eigen::Dynamic, 3>;

/// What one unit of time of noise, white or on its clock, gives free beads.
Velocities pushed(const Noise& noise, bool white, Jet<3> jet) {
  State<3> next;
  if (white) {
    auto f = equations<3>(plain_parameters());
    jet.slope = slope(f, jet);
    Sra1<3>(noise, wiener_path(noise.seed)).step(f, jet, jet, 1, next);
  } else {
    auto f = equations<3>(plain_parameters(), RandomForce<3>(noise));
    f.smooth_from(jet.t);
    next = jet.y + slope(f, jet);
  }
  return next.middleCols<3>(velocity_column<3>);
}

}  // namespace

TEST_CASE("The three components of a push know nothing of each other") {
  constexpr int n = 20000;
  Noise noise;
  noise.diffusivity = 0.5;  // variance 1 in the unit of time
  noise.interval = 1;
  for (const bool white : {false, true}) {
    const Velocities v = pushed(noise, white, free_beads(n, 0));
    CAPTURE(white);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < j; ++k)
        // four standard errors of the mean of a product of two normal numbers
        CHECK((v.col(j) * v.col(k)).mean() == Approx(0).margin(4 / std::sqrt(double(n))));
  }
}

TEST_CASE("A bead is pushed by its own noise, wherever in the jet it has come to stand") {
  Noise noise;
  noise.diffusivity = 0.5;
  noise.interval = 1;
  const Jet<3> whole = free_beads(5, 0);
  Jet<3> rest = whole;
  drop_first<3>(rest);
  for (const bool white : {false, true})
    CHECK((pushed(noise, white, whole).bottomRows(4) == pushed(noise, white, rest)).all());
}

TEST_CASE("A bead keeps its noise when elements are split before it, and a new bead has one of its own") {
  Noise noise;
  noise.diffusivity = 0.5;
  noise.interval = 1;
  Jet<3> whole = free_beads(6, 0);
  number_beads(whole);
  Jet<3> refined = whole;
  split<3>(refined, {2});
  for (const bool white : {false, true}) {
    const Velocities before = pushed(noise, white, whole), after = pushed(noise, white, refined);
    CAPTURE(white);
    CHECK((after.topRows(3) == before.topRows(3)).all());
    CHECK((after.bottomRows(3) == before.bottomRows(3)).all());
    for (Eigen::Index i = 0; i < 6; ++i) CHECK((before.row(i) != after.row(3)).all());
  }
}

TEST_CASE("The noise of air goes by the inverse mass, what shakes the fluid does not") {
  Noise noise;
  noise.diffusivity = 0.25;
  noise.diffusivity_in_air = 0.5;
  CHECK(noise.squared_amplitude(1) == Approx(1.5).epsilon(1e-15));
  CHECK(noise.squared_amplitude(4) == Approx(4.5).epsilon(1e-15));
}

TEST_CASE("The clock of noise goes on from the end of each interval, however that is rounded") {
  for (const double interval : {0.1, 0.3, 1. / 7, 1e-3}) {
    Noise noise;
    noise.interval = interval;
    RandomForce<3> force(noise);
    double t = 0;
    bool regular = true;
    for (int k = 1; k <= 3000; ++k) {
      const double end = force.smooth_from(t);
      regular = regular && std::abs(end - k * interval) < 1e-9 * interval;
      t = end;
    }
    CAPTURE(interval);
    CHECK(regular);
  }
}

TEST_CASE("White noise by SRA1 is of strong order 1.5 for beads that act on each other") {
  const Parameters p = plain_parameters();
  Noise noise;
  noise.diffusivity = 0.02;
  constexpr int finest = 4096;
  const double end = 1;
  const FinePath path(end / finest, finest);
  const auto end_by = [&](int steps) {
    auto f = equations<3>(p, Viscoelastic<3>(1, 4));
    auto jet = jet_of<3>({{Vec<3>(3.2, 0.1, 0), Vec<3>(0.4, 0, 0.3), 0.5},
                          {Vec<3>(2.1, 0, 0.2), Vec<3>(0.3, -0.2, 0), 0.3},
                          {Vec<3>(1, -0.2, 0.1), Vec<3>(0.2, 0.1, -0.1), 0.1}});
    Sra1<3> scheme(noise,
                   [&](std::int64_t bead, int k, double t, double h) { return path.over(bead, k, t, h); });
    State<3> next;
    for (int k = 0; k < steps; ++k) {
      jet.slope = slope(f, jet);
      scheme.step(f, jet, jet, end / steps, next);
      jet.t = end * (k + 1) / steps;
      jet.y = next;
    }
    return jet.y;
  };
  const State<3> reference = end_by(finest);
  std::vector<double> errors;
  for (const int steps : {16, 32, 64, 128, 256})
    errors.push_back(std::sqrt((end_by(steps) - reference).square().mean()));
  CAPTURE(errors);
  // one path: the mean order of four halvings scatters by about 0.1, and part of the error is of order 2
  const double order = std::log2(errors.front() / errors.back()) / 4;
  CHECK(order > 1.35);
  CHECK(order < 2.1);
}

TEST_CASE(
    "As the interval of the clock shrinks the random force moves beads as white noise does, on average") {
  // free Brownian motion from rest: <x^2> = 2 D t^3 / 3; on a clock of n intervals (1 + 1 / (2 n^2)) times
  // that
  constexpr int n = 20000;
  Noise noise;
  noise.diffusivity = 0.5;
  for (const int intervals : {1, 2, 8}) {
    noise.interval = 1. / intervals;
    auto f = equations<3>(plain_parameters(), RandomForce<3>(noise));
    auto jet = free_beads(n, 0);
    const State<3> start = jet.y;
    march_to<3>(1, noise.interval, jet, f, plain_parameters(), Scheme::heun);
    const double square = (jet.y - start).leftCols<3>().square().mean();
    const double expected = 1. / 3 - 1. / (12. * intervals * intervals);
    CAPTURE(intervals);
    CHECK(square == Approx(expected).margin(3 * expected * std::sqrt(2. / (3 * n))));
  }
}

TEST_CASE("The noise of JETSPIN's example 4 has the size that it prints") {
  Parameters p = example("pvp");
  p.airdrag = true;
  p.air_density = 0.00121;
  p.air_viscosity = 0.1511;
  p.airdrag_amplitude = 1;
  CHECK(noise(p).diffusivity_in_air == Approx(3.067e-6).epsilon(2e-4));  // Theta, four digits
}

TEST_CASE("A noisy jet has the same bits on any number of threads, and others for another seed") {
  Parameters p = with_tolerance(example("pvp"), 1e-5);
  p.noise = true;
  p.noise_diffusivity = 1e6;
  const auto end = [&](int threads) {
    Run<3> run(p, {threads});
    CHECK_FALSE(run.scene.multirate);
    run.to(2e-3);
    return run.jet().y;
  };
  const State<3> one = end(1);
  CHECK((end(3) == one).all());
  CHECK(one.leftCols<3>().rightCols<2>().abs().maxCoeff() > 0);
  ++p.seed;
  const State<3> other = end(1);
  CHECK((other.rows() != one.rows() || (other != one).any()));
}

TEST_CASE("The noise of a deck is scaled by its units of time and length") {
  Parameters p = example("pvp");
  p.noise = true;
  p.noise_diffusivity = 1e6;
  p.noise_variance = 400;
  const Scales s = scales(p);
  const Noise n = noise(p);
  CHECK(n.friction == Approx(1e6 / 400 * s.time).epsilon(1e-14));
  CHECK(n.diffusivity == Approx(1e6 * std::pow(s.time, 3) / (s.length * s.length)).epsilon(1e-14));
  const Stiffness rates = stiffness(p);  // the clock ticks twenty times in the shorter of the two
  REQUIRE(rates.bead_interval < rates.relaxation);
  CHECK(n.interval == Approx(rates.bead_interval / 20 / s.time).epsilon(1e-14));
}

TEST_CASE("The integral of a Wiener path knows of its end no more than half") {
  constexpr int n = 20000;
  constexpr double h = 0.3;
  const WienerPath path = wiener_path(5);
  double square = 0, cross = 0;
  for (int bead = 0; bead < n; ++bead) {
    const auto [dW, Z] = path(bead, 0, 1.5, h);
    const double rest = Z - h / 2 * dW;
    square += rest * rest / n;
    cross += rest * dW / n;
  }
  // given its end, a path is a bridge, whose integral has the variance h^3 / 12; four standard errors
  CHECK(square == Approx(h * h * h / 12).epsilon(4 * std::sqrt(2. / n)));
  CHECK(cross == Approx(0).margin(4 * h * h / std::sqrt(12. * n)));
}
