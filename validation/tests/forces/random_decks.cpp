/// Two rates against one on random legal decks: soft, stiff, over-charged, with a yield stress or a power
/// law, near the paper's case 3 and far from it. Beads are compared by their number since the start; the
/// truth is one rate at a tolerance ten thousand times tighter.

#include <catch2/catch.hpp>
#include <random>

#include "core/base/error.hpp"
#include "core/jet/stiffness.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

constexpr double tolerance = 1e-7;

/// Between low and high, evenly in the logarithm; the same numbers with every standard library.
class LogUniform {
 public:
  explicit LogUniform(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low * std::pow(high / low, double(random_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 random_;
};

/// One in eight each with a yield stress and with an index other than 1; one in eight stiff.
Parameters deck(unsigned seed) {
  LogUniform between(seed);
  Parameters p = with_tolerance(example("pvp"), tolerance);
  p.density_charge *= between(0.5, 2.5);
  p.elastic_modulus *= seed % 8 == 2 ? between(5, 300) : between(0.04, 5);
  p.viscosity *= between(0.3, 3);
  p.surface_tension *= between(0.1, 2);
  p.nozzle_velocity *= between(0.5, 20);
  p.initial_length = between(0.008, 0.03);
  p.collector_distance = between(1, 6);
  p.external_potential *= p.collector_distance / 16 * between(0.3, 3);
  p.perturb_frequency *= between(0.1, 3);
  p.perturb_amplitude *= between(0.1, 3);
  if (seed % 8 == 0) p.yield_stress = between(1e2, 1e5);
  p.hbfluid = seed % 8 == 1;
  p.hb_index = p.hbfluid ? between(0.6, 1.5) : 1;
  p.final_time = p.print_time.emplace(120 * stiffness(p).bead_interval);
  return p;
}

struct End {
  Jet<3> jet;
  bool multirate;
  std::string failure;  ///< empty if it came to its end
};

End end_of(Parameters p, double tol, Multirate multirate) {
  p.tolerance = tol;
  p.multirate = multirate;
  Run<3> run(p);
  std::string failure;
  try {
    run.to(p.final_time);
  } catch (const NumericalError& e) {
    failure = e.what();
  }
  return {run.jet(), run.scene.multirate != nullptr, failure};
}

bool same_bits(const End& a, const End& b) {
  return a.failure == b.failure && a.jet.removed == b.jet.removed && a.jet.size() == b.jet.size() &&
         (a.jet.y == b.jet.y).all();
}

/// How far the beads that both have are apart at the most in a coordinate, cm.
double apart(const End& a, const End& b, const Parameters& p) {
  if (!a.failure.empty() || !b.failure.empty()) return std::numeric_limits<double>::infinity();
  const auto from = std::max(a.jet.removed, b.jet.removed),
             to = std::min(a.jet.removed + a.jet.size(), b.jet.removed + b.jet.size());
  REQUIRE(from < to);
  const auto rows = [&](const End& e) { return e.jet.y.middleRows(from - e.jet.removed, to - from); };
  return (rows(a) - rows(b)).leftCols<3>().abs().maxCoeff() * scales(p).length;
}

struct Tally {
  int continued = 0;   ///< two rates were not one by another name
  int unpromised = 0;  ///< they err more than the promise and ten times what one rate errs
};

Tally compare(unsigned first, unsigned last) {
  Tally tally;
  for (unsigned seed = first; seed < last; ++seed) {
    const Parameters p = deck(seed);
    const End one = end_of(p, tolerance, Multirate::no), two = end_of(p, tolerance, Multirate::automatic);
    CAPTURE(seed, one.failure, two.failure);
    CHECK(one.failure.empty() == two.failure.empty());
    const bool rough = p.yield_stress > 0 || p.hb_index != 1;
    CHECK((!rough || !two.multirate));
    if (same_bits(one, two) || !one.failure.empty()) continue;
    ++tally.continued;
    const End truth = end_of(p, 1e-4 * tolerance, Multirate::no);
    const double by_one = apart(one, truth, p), by_two = apart(two, truth, p);
    // what a tolerance promises of case 3 once it whips (core/jet/error_norm.hpp)
    if (by_two <= std::max(64 * tolerance * p.collector_distance, 10 * by_one)) continue;
    ++tally.unpromised;
    // ill-conditioned: what is off by a tolerance at the nozzle grows on its way. A run at a tenth of the
    // tolerance must tell
    CAPTURE(by_one, by_two);
    CHECK(apart(two, end_of(p, tolerance / 10, Multirate::automatic), p) > by_two / 2);
  }
  return tally;
}

void check_decks(unsigned count) {
  const Tally tally = compare(0, count);
  CAPTURE(tally.continued, tally.unpromised);
  CHECK(tally.continued > int(count) / 20);  // the decks are such that it is asked at all
  CHECK(tally.unpromised <= int(count) / 100);
}

}  // namespace

TEST_CASE("On 40 random decks two rates err as one rate does or as the tolerance promises") {
  check_decks(40);
}

TEST_CASE("On 400 random decks two rates err as one rate does or as the tolerance promises", "[.whole]") {
  check_decks(400);
}
