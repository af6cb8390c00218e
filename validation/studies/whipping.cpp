/// The whipping of the PVP jet: frequency at fixed heights and wavelength along the axis, beside those that a
/// circling nozzle prints on a jet whose beads keep their phase.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "validation/support/run.hpp"
#include "validation/support/spectrum.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

using Samples = std::vector<std::complex<double>>;

constexpr double steady_from = 0.04;                    // s
constexpr double time_step = 1e-5;                      // s, an eighth of the time between two beads
constexpr double heights[] = {1, 4, 8, 12, 15};         // cm
constexpr double from_x = 8, to_x = 15.5, grid = 0.01;  // cm: where the wavelength is taken

struct Crossing {
  std::complex<double> displacement;  ///< y + i z, scaled
  double speed;                       ///< along the axis, scaled
};

/// Where the jet, seen from the nozzle as a polygon through its beads, first crosses the plane at x.
std::optional<Crossing> crossing(const Jet<3>& jet, const Nozzle<3>& nozzle, double x) {
  Vec<3> upper = nozzle.position(jet.t), upper_velocity = nozzle.velocity(jet.t);
  for (Eigen::Index i = jet.size() - 1; i >= 0; --i) {
    const Vec<3> lower = position<3>(jet.y, i), lower_velocity = velocity<3>(jet.y, i);
    if (lower.x() > x) {
      const double part = (x - upper.x()) / (lower.x() - upper.x());
      const Vec<3> r = upper + part * (lower - upper);
      return Crossing{{r.y(), r.z()}, upper_velocity.x() + part * (lower_velocity.x() - upper_velocity.x())};
    }
    upper = lower;
    upper_velocity = lower_velocity;
  }
  return std::nullopt;
}

/// The displacement at fixed heights, every `time_step` in the steady state.
class AtHeights final : public Sampling<3> {
 public:
  AtHeights(const Run<3>& run) : Sampling<3>(time_step / run.unit.time), run_(run) {}

  std::array<Samples, std::size(heights)> displacement;
  std::array<double, std::size(heights)> speed{};  ///< scaled, the last one

 protected:
  void sample(const Jet<3>& jet) override {
    if (jet.t * run_.unit.time < steady_from) return;
    for (std::size_t k = 0; k < std::size(heights); ++k) {
      const auto c = crossing(jet, run_.scene.nozzle, heights[k] / run_.unit.length);
      if (!c) continue;
      displacement[k].push_back(c->displacement);
      speed[k] = c->speed;
    }
  }

 private:
  const Run<3>& run_;
};

/// The displacement along the axis at the end of the run.
Samples along_axis(const Run<3>& run) {
  Samples samples;
  for (double x = from_x; x < to_x; x += grid)
    samples.push_back(crossing(run.jet(), run.scene.nozzle, x / run.unit.length).value().displacement);
  return samples;
}

double root_mean_square(const Samples& w) {
  double sum = 0;
  for (const auto& z : w) sum += std::norm(z);
  return std::sqrt(sum / double(w.size()));
}

struct Tables {
  ResultTable observables, in_time, along;
};

void whipping(Report& report, Tables& tables, double omega, double end) {
  Run<3> run(example("pvp", {fmt::format("perturb freq {}", omega)}));
  AtHeights at(run);
  run.to(end, {&at});
  const double expected = omega / (2 * std::numbers::pi), record = end - steady_from;
  for (std::size_t k = 0; k < std::size(heights); ++k) {
    const Spectrum s = spectrum(at.displacement[k], time_step);
    const double speed = at.speed[k] * run.unit.velocity;
    tables.observables.row({omega, heights[k], root_mean_square(at.displacement[k]) * run.unit.length,
                            expected, s.dominant, s.spread, speed, speed / s.dominant});
    for (std::size_t j = 0; j < s.power.size(); ++j)
      if (std::abs(s.frequency[j]) < 2e4) tables.in_time.row({omega, heights[k], s.frequency[j], s.power[j]});
    report.compare(fmt::format("{:g} rad/s: dominant frequency at {} cm, Hz", omega, heights[k]), s.dominant,
                   {expected, 0.1 / record, "the nozzle's, to a tenth of what the record resolves"});
  }
  const Samples w = along_axis(run);
  const Spectrum s = spectrum(w, grid);
  for (std::size_t j = 0; j < w.size(); ++j)
    tables.along.row(
        {omega, from_x + grid * double(j), w[j].real() * run.unit.length, w[j].imag() * run.unit.length});
  const double pitch = 1 / std::abs(s.dominant);
  const auto speed = [&](double x) {
    return crossing(run.jet(), run.scene.nozzle, x / run.unit.length)->speed * run.unit.velocity;
  };
  fmt::print(
      "{:g} rad/s: wavelength along the axis {:.4g} cm, wave numbers spread by {:.3g}/cm around {:.4g}/cm\n",
      omega, pitch, s.spread, s.dominant);
  report.check(
      fmt::format("{:g} rad/s: wavelength x frequency, between the axial speeds at {} (0) and {} cm (1)",
                  omega, from_x, to_x),
      (pitch * expected - speed(from_x)) / (speed(to_x) - speed(from_x)), 0, 1);
}

}  // namespace

void study_whipping(Report& report) {
  report.section(
      {"The spectrum of the whipping",
       "The displacement y + i z of the steady PVP jet, Fourier transformed in time at fixed heights and "
       "along "
       "the axis. A bead keeps the phase of the nozzle at its release, so the nozzle's frequency must appear "
       "at every height, and the wavelength must be the way along the axis in one turn.",
       "treejet-validate whipping --out DIR"});
  Tables tables{
      report.table("whipping", "Dominant frequency at fixed heights, and what it makes of the speed there",
                   {"omega [rad/s]", "height [cm]", "rms displacement [cm]", "nozzle [Hz]", "dominant [Hz]",
                    "spread [Hz]", "axial speed [cm/s]", "wavelength [cm]"}),
      ResultTable(report.directory(), "whipping_frequencies", "",
                  {"omega [rad/s]", "height [cm]", "frequency [Hz]", "power"}),
      ResultTable(report.directory(), "whipping_axis", "", {"omega [rad/s]", "x [cm]", "y [cm]", "z [cm]"})};
  for (const double omega : report.quick ? std::vector{1e4} : std::vector{5e3, 1e4, 2e4})
    whipping(report, tables, omega, report.quick ? 0.06 : 0.2);
}

}  // namespace treejet
