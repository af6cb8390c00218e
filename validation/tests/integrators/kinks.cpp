/// Forces that are smooth in pieces of time: no step goes over the border of two.

#include <catch2/catch.hpp>

#include <cmath>

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
