#include "validation/support/experiment.hpp"

#include <fmt/format.h>

#include <ctime>

#include "core/base/error.hpp"
#include "core/observe/outputs.hpp"
#include "integrators/run/integration.hpp"

namespace treejet {

namespace {

struct GivenUp : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A motion that gives up after so many evaluations: a run that fails must fail in finite time.
template <int D>
class Limited final : public RightHandSide<D> {
 public:
  Limited(RightHandSide<D>& motion, std::int64_t most) : motion_(motion), left_(most) {}

  void operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) override {
    count();
    motion_(jet, t, y, slope);
  }
  bool on_accepted_step(const Jet<D>& jet, double t, const State<D>& y, const State<D>* known,
                        State<D>& slope) override {
    const bool evaluated = motion_.on_accepted_step(jet, t, y, known, slope);
    if (evaluated) count();
    return evaluated;
  }
  double smooth_from(double t) override { return motion_.smooth_from(t); }
  double longest_step() const override { return motion_.longest_step(); }
  void differentiate(const Jet<D>& jet, double t, const State<D>& y, LocalJacobian<D>& J) override {
    motion_.differentiate(jet, t, y, J);
  }
  const FastRegion<D>* fast_region(const Jet<D>& jet) override { return motion_.fast_region(jet); }
  void complete(const Jet<D>& jet, double h, const State<D>& some, State<D>& next) override {
    motion_.complete(jet, h, some, next);
  }
  void before_removal(const Jet<D>& jet) override { motion_.before_removal(jet); }
  void after_release(const Jet<D>& jet) override { motion_.after_release(jet); }

 private:
  void count() {
    if (--left_ < 0) throw GivenUp("given up: too many evaluations");
  }

  RightHandSide<D>& motion_;
  std::int64_t left_;
};

/// Keeps the time up to which a run has come.
template <int D>
class Clock final : public Observer<D> {
 public:
  double t = 0;
  void segment(const Jet<D>&, const DenseOutput<D>& segment) override { t = segment.until; }
};

double processor_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

template <int D>
std::unique_ptr<Outputs<D>> outputs(const Parameters& p, const Scene<D>& scene, const Setup& setup) {
  if (setup.results.empty()) return nullptr;
  return std::make_unique<Outputs<D>>(p, scene.nozzle, scene.collector,
                                      OutputSetting{setup.results, OutputFile::Existing::replace, true});
}

template <int D>
Outcome run(const Parameters& p, const Setup& setup) {
  Scene<D> scene = compose<D>(p, Threads{1});
  for (const Alteration& a : setup.alterations) scene.jet.y(a.bead, a.column) = a.value;
  Limited<D> motion(scene.right_hand_side(), setup.most_evaluations);
  Clock<D> clock;
  const auto files = outputs<D>(p, scene, setup);
  auto observers = files ? files->observers() : std::vector<Observer<D>*>{};
  observers.push_back(&clock);
  Integration<D> integration(p, system(scene, motion), observers);
  const double time_unit = scales(p).time, length_unit = scales(p).length;
  Outcome o;
  const double started = processor_seconds();
  try {
    integration.march.to(p.final_time / time_unit);
  } catch (const Error& e) {
    o.exit_code = e.exit_code();
    o.message = e.what();
  } catch (const GivenUp& e) {
    o.exit_code = Outcome::given_up;
    o.message = e.what();
  }
  o.seconds = processor_seconds() - started;
  o.t = clock.t * time_unit;
  o.removed = scene.jet.removed;
  o.effort = integration.march.effort();
  o.position.setZero(scene.jet.size(), 3);
  o.position.leftCols(D) = scene.jet.y.template leftCols<D>() * length_unit;
  return o;
}

}  // namespace

Parameters with(Parameters p, const Method& method) {
  p.integrator = method.scheme;
  p.timestep = method.timestep;
  p.tolerance = method.tolerance;
  p.multirate = method.multirate;
  p.events = method.events;
  return p;
}

Outcome experiment(const Parameters& p, const Setup& setup) {
  const auto once = [&] { return p.system == 1 ? run<1>(p, setup) : run<3>(p, setup); };
  constexpr double long_enough = 0.1;  // s: the clock and the machine's moods hardly count
  Outcome cheapest = once();
  for (int i = 1; i < setup.repeats && cheapest.seconds < long_enough; ++i) {
    Outcome again = once();
    if (again.seconds < cheapest.seconds) cheapest = std::move(again);
  }
  return cheapest;
}

double distance(const Outcome& a, const Outcome& b) {
  const auto first = std::max(a.removed, b.removed);
  const auto n = std::min(a.removed + a.position.rows(), b.removed + b.position.rows()) - first;
  if (!a.done() || !b.done() || !a.finite() || !b.finite() || n <= 0) {
    return std::numeric_limits<double>::infinity();
  }
  const auto difference =
      a.position.middleRows(first - a.removed, n) - b.position.middleRows(first - b.removed, n);
  return difference.matrix().rowwise().norm().maxCoeff();
}

std::string name(const Method& method) {
  return fmt::format("{}{}{}", name(method.scheme), method.multirate == Multirate::no ? "" : ", multirate",
                     method.events == EventRule::located ? "" : ", events at step ends");
}

}  // namespace treejet
