#include "integrators/run/cost_estimate.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/io/output_files.hpp"
#include "core/jet/scales.hpp"
#include "core/observe/progress.hpp"

namespace treejet {

namespace {

/// The number of beads over time: linear up to a moment, constant from there on. Scaled.
struct Growth {
  double begin, beads, rate, full;

  double at(double t) const { return beads + rate * (std::min(t, full) - begin); }
};

/// Cost of an evaluation, alpha + beta n^k seconds.
struct Cost {
  double alpha = 0, beta = 0, k = 1;

  double of(double n) const { return alpha + beta * std::pow(n, k); }
};

/// Least squares over the slices between samples, neither coefficient below zero.
Cost cost(const std::vector<TrialSample>& samples, double k) {
  double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const TrialSample &a = samples[i - 1], &b = samples[i];
    const double evaluations = double(b.evaluations - a.evaluations);
    if (evaluations <= 0) continue;
    const double x = std::pow(0.5 * double(a.beads + b.beads), k), y = (b.seconds - a.seconds) / evaluations;
    w += evaluations, wx += evaluations * x, wy += evaluations * y;
    wxx += evaluations * x * x, wxy += evaluations * x * y;
  }
  const double spread = w * wxx - wx * wx;
  if (w == 0) return {0, 0, k};
  const double beta = spread > 1e-9 * w * wxx ? std::max(0.0, (w * wxy - wx * wy) / spread) : 0;
  const double alpha = (wy - beta * wx) / w;
  if (alpha < 0) return {0, wy / wx, k};
  return {alpha, beta, k};
}

/// Time the first bead still needs to the collector, from the header. Scaled.
double flight(const Parameters& p, const TrialSample& middle, const TrialSample& last) {
  const Groups g = groups(p);
  const double way = std::max(0.0, g.H - last.x);
  const double a = std::max((last.v - middle.v) / (last.t - middle.t), g.V + g.F_g);
  if (a <= 0) return way / std::max(last.v, 1e-300);
  return (std::sqrt(last.v * last.v + 2 * a * way) - last.v) / a;
}

/// Where half of the work was done, or the start: by the clock a moment in which the machine did something
/// else might leave nothing behind it.
const TrialSample& middle(const std::vector<TrialSample>& samples) {
  const TrialSample& last = samples.back();
  const auto beyond = [&](const TrialSample& s) {
    return 2 * s.evaluations > last.evaluations || s.t >= last.t;
  };
  const auto found = std::find_if(samples.begin(), samples.end(), beyond);
  return found == samples.begin() ? *found : *(found - 1);
}

double mean_since_arrival(const std::vector<TrialSample>& samples) {
  double sum = 0, count = 0;
  for (const auto& s : samples)
    if (s.removed > 0) sum += double(s.beads), ++count;
  return sum / count;
}

/// An upper estimate of what a bead costs: the columns of its state at both ends of a step, in the stages and
/// in the history of fields.
constexpr double bytes_a_bead = 4096;

double memory_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

double memory_of_machine() {
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
}

std::string bytes_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.3g} kB", bytes / 1e3);
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

}  // namespace

void expect_feasible_trial(const Parameters& p) {
  constexpr double most_pairs = 5e9, pairs_a_second = 1e9;  // of one core; a step has some ten evaluations
  const double n = initial_elements(p), pairs = n * n, memory = memory_of_machine();
  if (n * bytes_a_bead > memory)
    throw InputError(
        fmt::format("{:.3g} beads at the start need up to {}, this machine has {}: not tried out; "
                    "expected fewer points or a larger resolution",
                    n, bytes_text(n * bytes_a_bead), bytes_text(memory)));
  if (p.coulomb == CoulombSum::direct && !p.cutoff && pairs > most_pairs)
    throw InputError(
        fmt::format("coulomb direct: one sum over {:.3g} beads is {:.2g} pairs, {} on one core: "
                    "not tried out; did you mean coulomb auto?",
                    n, pairs, duration_text(pairs / pairs_a_second)));
}

Plan plan(const Parameters& p, const Trial& trial, bool all_pairs) {
  const TrialSample &last = trial.samples.back(), &mid = middle(trial.samples);
  const double time = scales(p).time, end = p.final_time / time, left = trial.complete ? 0 : end - last.t;
  Plan plan;
  for (std::size_t i = 0; i < trial.samples.size(); ++i) {
    const TrialSample& s = trial.samples[i];
    plan.most_beads = std::max(plan.most_beads, double(s.beads));
    if (i > 0) plan.mean_beads += (s.t - trial.samples[i - 1].t) / end * double(s.beads);
  }
  if (trial.first_arrival) plan.first_arrival = *trial.first_arrival * time;
  plan.inserted = double(last.inserted);
  plan.evaluations = double(last.evaluations);
  plan.steps = double(last.steps);
  plan.seconds = last.seconds;
  if (left > 0) {
    const auto rate = [&](auto member) { return double(last.*member - mid.*member) / (last.t - mid.t); };
    Growth growth{last.t, double(last.beads), rate(&TrialSample::inserted), end};
    plan.inserted += growth.rate * left;
    if (last.removed > 0) {
      growth.beads = mean_since_arrival(trial.samples);
      growth.full = growth.begin;
    } else if (p.removing) {
      growth.full = std::min(end, last.t + flight(p, mid, last));
      if (growth.full < end) plan.first_arrival = growth.full * time;
    }
    const double evaluations = rate(&TrialSample::evaluations);
    const Cost of_evaluation = cost(trial.samples, all_pairs ? 2 : 1);
    plan.evaluations += evaluations * left;
    plan.steps += rate(&TrialSample::steps) * left;
    constexpr int slices = 1000;
    for (int i = 0; i < slices; ++i) {
      const double n = growth.at(last.t + (i + 0.5) / slices * left);
      plan.most_beads = std::max(plan.most_beads, n);
      plan.mean_beads += n * left / slices / end;
      plan.seconds += evaluations * left / slices * of_evaluation.of(n);
    }
  }
  plan.memory = memory_now() + bytes_a_bead * plan.most_beads;
  return plan;
}

std::string plan_description(const Parameters& p, const Trial& trial, bool all_pairs) {
  const Plan e = plan(p, trial, all_pairs);
  const double time = scales(p).time;
  std::string text =
      fmt::format("plan, from {} of {:.2g} s to t = {:.3g} s\n", trial.complete ? "a whole run" : "a trial",
                  trial.samples.back().seconds, trial.samples.back().t * time);
  text += fmt::format("  beads       {:.0f} at most, {:.0f} in the mean; {:.0f} inserted", e.most_beads,
                      e.mean_beads, e.inserted);
  text += e.first_arrival ? fmt::format("; the first arrives at t = {:.3g} s\n", *e.first_arrival)
                          : "; none arrives\n";
  text +=
      fmt::format("  work        {:.3g} evaluations of the forces in {:.3g} steps\n", e.evaluations, e.steps);
  text += fmt::format("  time        {} on this machine, as busy as it is now, and that of writing files\n",
                      e.seconds < 1 ? fmt::format("{:.2g} s", e.seconds) : duration_text(e.seconds));
  text += fmt::format("  memory      {}\n", bytes_text(e.memory));
  const double points = e.mean_beads + 1;  // the nozzle
  for (const OutputFileKind& file : output_files(p)) {
    text += fmt::format("  {:<12}{}", file.name, bytes_text(file.bytes(p, points)));
    if (file.bytes_meanwhile)
      text += fmt::format(", before the end up to {}", bytes_text(file.bytes_meanwhile(p, points)));
    text += "\n";
  }
  return text;
}

}  // namespace treejet
