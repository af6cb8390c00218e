#include "validation/support/scaling_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <sstream>
#include <string_view>

#include "forces/scene/distribute.hpp"
#include "integrators/run/integration.hpp"
#include "validation/support/experiment.hpp"
#include "validation/support/machine.hpp"
#include "validation/support/part_of_jet.hpp"

namespace treejet {

namespace {

constexpr double grown_at = 0.012;  // s: the jet has reached the collector

/// Between rows a and a + 1 of a table whose last row has no successor but `end`; cubic by Catmull and Rom.
Vec<3> between(const State<3>& y, int first_column, Eigen::Index a, double part, const Vec<3>& end) {
  const auto row = [&](Eigen::Index i) -> Vec<3> {
    if (i >= y.rows()) return end;
    return y.row(std::max<Eigen::Index>(i, 0)).segment<3>(first_column).matrix().transpose();
  };
  const Vec<3> p0 = row(a - 1), p1 = row(a), p2 = row(a + 1), p3 = row(a + 2);
  return p1 +
         part / 2 * (p2 - p0 + part * (2 * p0 - 5 * p1 + 4 * p2 - p3 + part * (3 * (p1 - p2) + p3 - p0)));
}

void march(const Parameters& p, Scene<3>& scene, RightHandSide<3>& motion, double until) {
  Integration<3>(p, system(scene, motion)).march.to(until / scales(p).time);
}

/// The same jet with each element cut in `pieces`. The unit of length goes with l_step, those of time and
/// stress stay.
Jet<3> refined(const Jet<3>& jet, const Nozzle<3>& nozzle, int pieces) {
  const Vec<3> end = nozzle.position(jet.t), rest = nozzle.velocity(jet.t);
  Jet<3> out;
  out.t = jet.t;
  out.y.resize(jet.size() * pieces, Eigen::NoChange);
  out.mass.setOnes(out.size());
  out.charge.setOnes(out.size());
  out.volume.setOnes(out.size());
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double part = double(i % pieces) / pieces;
    out.y.row(i) << pieces * between(jet.y, 0, i / pieces, part, end).transpose().array(),
        pieces * between(jet.y, velocity_column<3>, i / pieces, part, rest).transpose().array(),
        jet.y(i / pieces, stress_column<3>);
  }
  return out;
}

struct Over {};

/// Takes the time of the evaluations after a warm-up, then breaks off.
class Stopwatch final : public RightHandSide<3> {
 public:
  Stopwatch(RightHandSide<3>& motion, const ScalingRun& run, const Ranks& ranks)
      : motion_(motion),
        warm_up_(std::max(2, run.evaluations / 8)),
        end_(warm_up_ + run.evaluations),
        ranks_(ranks) {}

  void operator()(const Jet<3>& jet, double t, const State<3>& y, State<3>& slope) override {
    if (count_ == warm_up_) start_ = now(), times_ = ranks_.times();
    if (count_ == end_) finish();
    motion_(jet, t, y, slope);
    slope_ = &slope;
    ++count_;
  }
  void before_removal(const Jet<3>& jet) override { motion_.before_removal(jet); }
  void after_release(const Jet<3>& jet) override { motion_.after_release(jet); }

  Measurement result;

 private:
  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  [[noreturn]] void finish() {
    const double n = end_ - warm_up_;
    result.seconds = (now() - start_) / n;
    const GatherTimes times = ranks_.times();
    result.exchange = (times.exchange - times_.exchange) / n;
    result.wait = (times.wait - times_.wait) / n;
    const std::string_view bytes(reinterpret_cast<const char*>(slope_->data()),
                                 static_cast<std::size_t>(slope_->size()) * sizeof(double));
    result.bits = fmt::format("{:016x}", std::hash<std::string_view>{}(bytes));
    throw Over{};
  }

  RightHandSide<3>& motion_;
  int warm_up_, end_, count_ = 0;
  const Ranks& ranks_;
  double start_ = 0;
  GatherTimes times_;
  const State<3>* slope_ = nullptr;
};

}  // namespace

Measurement measure(const ScalingRun& r, const Ranks& ranks) {
  const Parameters coarse = example("pvp");
  Scene<3> grown = compose<3>(coarse, {1});
  march(coarse, grown, grown.right_hand_side(), grown_at);

  const Parameters p =
      example("pvp", {fmt::format("points {}", r.refinement), "multirate no", "print list t",
                      "printstat list t", r.sum == CoulombSum::direct ? "coulomb direct" : "coulomb tree",
                      r.subdomains ? "parallel distributed" : "parallel replicated"});
  const Threads threads{r.threads};
  Scene<3> scene = compose<3>(p, threads, ranks);
  const Jet<3> jet = refined(grown.jet, grown.nozzle, r.refinement);
  if (r.subdomains)
    distribute(
        scene, p, static_cast<int>(jet.size()), [&](const std::vector<int>& rows) { return part(jet, rows); },
        threads, ranks);
  else
    scene.jet = jet;
  Stopwatch stopwatch(scene.right_hand_side(), r, ranks);
  try {
    march(p, scene, stopwatch, 1);
  } catch (const Over&) {
  }
  stopwatch.result.beads = static_cast<int>(scene.decomposition().beads(scene.jet));
  stopwatch.result.cores = cores_of(ranks);
  return stopwatch.result;
}

std::string text(const Measurement& m) {
  return fmt::format("measured {} {} {} {} {} {}\n", m.beads, m.seconds, m.exchange, m.wait, m.bits, m.cores);
}

Measurement measurement(const std::string& text) {
  Measurement m;
  std::string word;
  std::istringstream(text) >> word >> m.beads >> m.seconds >> m.exchange >> m.wait >> m.bits >> m.cores;
  return m;
}

}  // namespace treejet
