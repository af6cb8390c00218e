#include "integrators/run/trial_run.hpp"

#include <chrono>

#include "core/jet/scales.hpp"

namespace treejet {

namespace {

/// Where the jet is and how many beads have come and gone.
template <int D>
class Onlooker final : public Observer<D> {
 public:
  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override {
    now_.t = segment.until;
    now_.beads = segment.first().rows() + jet.held;
    now_.x = segment.first()(0, 0);
    now_.v = segment.first()(0, velocity_column<D>);
  }
  void event(EventKind kind, const Jet<D>& jet) override {
    now_.inserted += kind == EventKind::place;
    now_.removed += kind == EventKind::removal;
    if (now_.removed > 0 && !first_arrival) first_arrival = jet.t;
  }

  TrialSample sample(double seconds, const Effort& effort) const {
    TrialSample s = now_;
    s.seconds = seconds;
    s.evaluations = effort.evaluations;
    s.steps = effort.steps;
    return s;
  }

  std::optional<double> first_arrival;

 private:
  TrialSample now_;
};

}  // namespace

template <int D>
Trial trial_run(const Parameters& p, const System<D>& system, double seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr int samples = 64;
  const auto started = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - started).count(); };
  Onlooker<D> onlooker;
  Trial trial;
  trial.samples.resize(1);
  trial.samples[0].beads = system.jet.size();
  const March<D>* watched = nullptr;
  const auto stop_here = [&] {
    const double now = elapsed();
    if (now >= double(trial.samples.size()) * seconds / samples)
      trial.samples.push_back(onlooker.sample(now, watched->effort()));
    return now >= seconds && watched->effort().steps > 0;  // of no step nothing follows
  };
  Integration<D> integration(p, system, {&onlooker}, stop_here);
  March<D>& march = integration.march;
  watched = &march;
  trial.complete = march.to(p.final_time / scales(p).time);
  trial.samples.push_back(onlooker.sample(elapsed(), march.effort()));
  trial.first_arrival = onlooker.first_arrival;
  return trial;
}

template Trial trial_run<1>(const Parameters&, const System<1>&, double);
template Trial trial_run<3>(const Parameters&, const System<3>&, double);

}  // namespace treejet
