/// Forces that are smooth in pieces of time: no step goes over the border of two.

#include <catch2/catch.hpp>

#include <cmath>

#include "core/base/error.hpp"
#include "forces/multirate/multirate_motion.hpp"
#include "validation/support/scenes.hpp"

using namespace treejet;

namespace {

/// A push that grows within each interval and begins anew in the next: a = t - k tau in [k tau, (k + 1) tau).
class Sawtooth final : public ForceTerm<1> {
 public:
  explicit Sawtooth(double tau) : tau_(tau) {}
  std::string_view name() const override { return "sawtooth"; }
  double smooth_from(double t) override {
    constexpr double round_off = 1e-9;
    begin_ = tau_ * std::floor(t / tau_ + round_off);
    return begin_ + tau_;
  }
  void add(const Chain<1>& chain, Rows rows, Acceleration<1>& a) const override {
    a.middleRows(rows.first, rows.size()) += chain.t - begin_;
  }

 private:
  double tau_, begin_ = 0;
};

constexpr double tau = 0.3, end = 2;  // six teeth and two thirds of one

/// v of a bead at rest at first: tau^2 / 2 a tooth.
double closed_speed() {
  const double teeth = std::floor(end / tau), rest = end - teeth * tau;
  return teeth * tau * tau / 2 + rest * rest / 2;
}

struct Ends final : Observer<1> {
  void segment(const Jet<1>&, const DenseOutput<1>& s) override {
    const double first = std::floor(s.begin() / tau + 1e-9), last = std::ceil(s.until / tau - 1e-9);
    astride += last - first > 1;
    ++steps;
  }
  int astride = 0, steps = 0;
};

double speed_at_end(Parameters p, Ends& ends) {
  auto f = equations<1>(p, Sawtooth(tau));
  Jet<1> jet = jet_of<1>({bead_at(1)});
  const Nozzle<1> nozzle(p);
  const Collector collector(p);
  Integration<1>(p, {jet, f, nozzle, collector}, {&ends}).march.to(end);
  return jet.y(0, velocity_column<1>);
}

}  // namespace

TEST_CASE("A step ends where a force jumps, whatever the scheme, and the order does not suffer") {
  for (const Scheme scheme : {Scheme::heun, Scheme::rk4, Scheme::dopri5, Scheme::verner6}) {
    CAPTURE(name(scheme));
    Parameters p = plain_parameters();
    p.integrator = scheme;
    p.timestep = 0.07 * scales(p).time;  // no divisor of the interval
    Ends ends;
    // all these schemes integrate a force linear in time exactly
    CHECK(speed_at_end(p, ends) == Approx(closed_speed()).epsilon(1e-13));
    CHECK(ends.astride == 0);
  }
}

TEST_CASE("Adaptive steps meet the jumps of a force and are as long as these let them") {
  for (const Scheme scheme : {Scheme::dopri5, Scheme::verner6, Scheme::kencarp5}) {
    CAPTURE(name(scheme));
    Parameters p = plain_parameters();
    p.integrator = scheme;
    p.tolerance = 1e-6;
    p.final_time = 2 * end * scales(p).time;
    Ends ends;
    CHECK(speed_at_end(p, ends) == Approx(closed_speed()).epsilon(1e-12));
    CHECK(ends.astride == 0);
    CHECK(ends.steps < 100);  // a search for seven jumps by rejected steps takes several hundred
  }
}

namespace {

/// Begins each interval of tau with a push that dies away within a thousandth of it.
class Pulses final : public ForceTerm<1> {
 public:
  std::string_view name() const override { return "pulses"; }
  double smooth_from(double t) override { return (begin_ = tau * std::floor(t / tau + 1e-9)) + tau; }
  void add(const Chain<1>& chain, Rows rows, Acceleration<1>& a) const override {
    a.middleRows(rows.first, rows.size()) += std::exp(-1000 * (chain.t - begin_) / tau);
  }

 private:
  double begin_ = 0;
};

/// Pushes one bead to and fro, from time 5 on faster than any step can follow.
class Roughness final : public ForceTerm<3> {
 public:
  explicit Roughness(int bead) : bead_(bead) {}
  std::string_view name() const override { return "roughness"; }
  void add(const Chain<3>& chain, Rows rows, Acceleration<3>& a) const override {
    if (rows.first <= bead_ && bead_ < rows.last && chain.t > 5)
      a(bead_, 0) += 1e30 * std::sin(1e12 * chain.t);
  }

 private:
  int bead_;
};

}  // namespace

TEST_CASE("A step that ends at a kink ends there to the bit, and none is made of what rounding leaves") {
  struct Slivers final : Observer<1> {
    void segment(const Jet<1>&, const DenseOutput<1>& s) override { count += s.until - s.begin() < 1e-12; }
    int count = 0;
  } slivers;
  Parameters p = plain_parameters();
  p.integrator = Scheme::dopri5;
  p.tolerance = 1e-6;
  p.final_time = 1000 * scales(p).time;
  auto f = equations<1>(p, Sawtooth(tau));
  Jet<1> jet = jet_of<1>({bead_at(1)});
  const Nozzle<1> nozzle(p);
  const Collector collector(p);
  Integration<1>(p, {jet, f, nozzle, collector}, {&slivers})
      .march.to(119.9);  // 400 teeth, the last one not to its end
  CHECK(slivers.count == 0);
}

TEST_CASE("The first step after a kink is the one that the last kink allowed, without a search") {
  Parameters p = plain_parameters();
  p.integrator = Scheme::dopri5;
  p.tolerance = 1e-6;
  p.final_time = 2 * end * scales(p).time;
  auto f = equations<1>(p, Pulses());
  Jet<1> jet = jet_of<1>({bead_at(1)});
  const Nozzle<1> nozzle(p);
  const Collector collector(p);
  Integration<1> integration(p, {jet, f, nozzle, collector});
  integration.march.to(end);
  // the first two pulses are searched for; six more find a step of half a tooth too long by a factor of 500
  // if nobody tells, and a step may shrink by 5 or so at a time
  CHECK(integration.march.effort().rejected < 14);
}

TEST_CASE("A step that has become too small names the bead of the whole jet, whoever was followed") {
  Parameters p = plain_parameters();
  p.integrator = Scheme::dopri5;
  p.tolerance = 1e-6;
  p.final_time = 10 * scales(p).time;
  auto f = equations<3>(p, Roughness(97), CoulombForce<3>(1e-20, 1 << 30));
  MultirateMotion<3> two(f, ErrorNorm(p), ShortWaves(p));
  std::vector<Bead<3>> beads;
  for (int x = 100; x > 0; --x) beads.push_back({Vec<3>(x, 0, 0), Vec<3>::Zero()});
  Jet<3> jet = jet_of<3>(beads);
  const Nozzle<3> nozzle(p);
  const Collector collector(p);
  Integration<3> integration(p, {jet, two, nozzle, collector});
  CHECK_THROWS_WITH(integration.march.to(10), Catch::Contains("because of bead number 97 since"));
  CHECK(two.fast_region(jet));  // 44 beads were followed
}
