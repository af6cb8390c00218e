#include "validation/support/deck_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/base/error.hpp"
#include "core/io/field_map_file.hpp"
#include "core/jet/scales.hpp"
#include "core/restart/origin.hpp"
#include "forces/coulomb/coulomb.hpp"
#include "forces/scene/distribute.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/support/machine.hpp"
#include "validation/support/part_of_jet.hpp"

namespace treejet {

namespace {

using Clock = std::chrono::steady_clock;

/// The first steps find room for everything, and two rates need three evaluations to begin with.
std::int64_t warm_up(const DeckRun& run) {
  return std::clamp<std::int64_t>(run.steps / 10, 1, 10);
}

struct Instant {
  Clock::time_point time;
  WorkSeconds work;
  Effort effort;
};

/// Asked between any two steps, as whoever stops runs is: notes begin and end of the stretch.
template <int D>
class Stretch {
 public:
  explicit Stretch(const DeckRun& run) : run_(run), warm_up_(warm_up(run)) {}

  StopRequest operator()(const Simulation<D>& simulation) {
    const std::int64_t taken = asked_++ - warm_up_;
    if (taken == 0) begin_ = now(simulation);
    const bool over = taken >= run_.steps || (taken > 0 && since(begin_->time) >= run_.seconds);
    if (over) end_ = now(simulation);
    return over ? StopRequest::stop : StopRequest::go_on;
  }

  /// Of a run that has come to an end by itself, up to there.
  void close(const Simulation<D>& simulation) {
    if (!end_) end_ = now(simulation);
    if (!begin_ || end_->effort.steps == begin_->effort.steps)
      throw InputError(fmt::format("{}: the jet has left after {} steps, before there was one to measure",
                                   run_.deck, end_->effort.steps));
  }

  static double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }
  const Instant& begin() const { return *begin_; }
  const Instant& end() const { return *end_; }

 private:
  Instant now(const Simulation<D>& simulation) const {
    return {Clock::now(), clock_.seconds(), simulation.effort()};
  }

  const DeckRun& run_;
  WorkClock clock_;
  std::int64_t warm_up_, asked_ = 0;
  std::optional<Instant> begin_, end_;
};

/// Puts another jet in the place of the deck's initial one.
template <int D>
void begin_with(const Origin& origin, const Parameters& p, Scene<D>& scene, Threads threads,
                const Ranks& ranks) {
  Parameters whole = p;
  whole.parallel = ParallelData::replicated;
  const Jet<D> jet = jet_of<D>(origin, whole, scene.columns);
  if constexpr (D == 3)
    if (scene.subdomains) {
      const bool two_rates = scene.multirate != nullptr;
      const auto some = [&](const std::vector<int>& rows) { return part(jet, rows); };
      return distribute(scene, p, static_cast<int>(jet.size()), some, threads, ranks, two_rates);
    }
  scene.jet = jet;
}

template <int D>
std::string bits(const Jet<D>& jet) {
  const std::string_view bytes(reinterpret_cast<const char*>(jet.y.data()),
                               static_cast<std::size_t>(jet.y.size()) * sizeof(double));
  return fmt::format("{:016x}", std::hash<std::string_view>{}(bytes));
}

/// What was measured here, with that of the other ranks.
void combine(DeckMeasurement& m, const Ranks& ranks) {
  double others = 0;
  for (std::size_t k = 0; k < m.work.size(); ++k)
    if (k != static_cast<std::size_t>(Work::exchange)) others += m.work[k];
  m.busiest = ranks.greatest(others);
  m.memory = ranks.greatest(peak_bytes());
  m.seconds = ranks.greatest(m.seconds);
  ranks.sum(m.work);
  for (double& seconds : m.work) seconds /= ranks.size();
  m.cores = cores_of(ranks);
}

template <int D>
DeckMeasurement measured(const DeckRun& run, const Ranks& ranks) {
  const Deck deck = deck_of(run);
  const Parameters& p = deck.parameters;
  const Threads threads{run.threads};
  Scene<D> scene = compose<D>(p, threads, ranks);
  if (!run.from.empty()) begin_with<D>(origin(run.from), p, scene, threads, ranks);
  Stretch<D> stretch(run);
  const Simulation<D>* asking = nullptr;
  const OutputSetting outputs{.directory = run.directory,
                              .existing = OutputFile::Existing::replace,
                              .quiet = true,
                              .elsewhere = !ranks.first(),
                              .made_by = provenance(deck, isa_name()),
                              .circumstances = {ranks.size(), run.threads},
                              .force_error = scene.force_error()};
  Simulation<D> simulation(deck, system(scene), {outputs, [&] { return stretch(*asking); }});
  asking = &simulation;
  simulation.finish();
  stretch.close(simulation);
  const Instant &begin = stretch.begin(), &end = stretch.end();
  DeckMeasurement m;
  m.checkpoint = stretch.since(end.time);
  m.seconds = std::chrono::duration<double>(end.time - begin.time).count();
  m.beads = scene.decomposition().beads(scene.jet);
  m.steps = end.effort.steps - begin.effort.steps;
  m.evaluations = end.effort.evaluations - begin.effort.evaluations;
  for (std::size_t k = 0; k < m.work.size(); ++k) m.work[k] = end.work[k] - begin.work[k];
  m.t = simulation.t(), m.x = scene.jet.y(0, 0) * scales(p).length;
  m.bits = bits(scene.jet);
  m.sum = scene.force_error() ? scene.force_error()->method : "-";
  combine(m, ranks);
  return m;
}

}  // namespace

Deck deck_of(const DeckRun& run) {
  std::vector<std::string> overrides = run.overrides;
  overrides.push_back(fmt::format("parallel {}", run.subdomains ? "distributed" : "replicated"));
  Deck deck = read_deck(run.deck, overrides);
  read_field_map_of(deck);
  constexpr double endless = 1e6;
  deck.parameters.final_time *= endless;
  return deck;
}

DeckMeasurement measure(const DeckRun& run, const Ranks& ranks) {
  return deck_of(run).parameters.system == 1 ? measured<1>(run, ranks) : measured<3>(run, ranks);
}

std::string text(const DeckMeasurement& m) {
  return fmt::format("measured {} {} {} {} {} {} {} {} {} {} {} {} {}\n", m.beads, m.steps, m.evaluations,
                     m.seconds, fmt::join(m.work, " "), m.busiest, m.checkpoint, m.memory, m.t, m.x, m.bits,
                     m.cores, m.sum);
}

DeckMeasurement deck_measurement(const std::string& text) {
  DeckMeasurement m;
  std::istringstream line(text);
  std::string word;
  line >> word >> m.beads >> m.steps >> m.evaluations >> m.seconds;
  for (double& seconds : m.work) line >> seconds;
  line >> m.busiest >> m.checkpoint >> m.memory >> m.t >> m.x >> m.bits >> m.cores >> std::ws;
  std::getline(line, m.sum);
  return m;
}

}  // namespace treejet
