#include "integrators/run/simulation.hpp"

#include <fmt/format.h>

#include "core/io/output_files.hpp"
#include "core/jet/scales.hpp"
#include "parallel/sampled_work.hpp"

namespace treejet {

namespace {

template <int D>
OutputSetting output_setting(OutputSetting outputs, const System<D>& system, const Checkpoint* resumed) {
  outputs.added = system.columns;
  outputs.chunks_shared = tasks_shared(system.threads);
  if (resumed) {
    outputs.existing = OutputFile::Existing::resume;
    outputs.resumed = &resumed->state;
  }
  return outputs;
}

/// The watchers of a run, whose time is told from that of the rest.
template <int D>
class Watchers final : public Observer<D> {
 public:
  explicit Watchers(std::vector<Observer<D>*> all) : all_(std::move(all)) {}

  void start(const Jet<D>& jet) override {
    tell([&](Observer<D>& w) { w.start(jet); });
  }
  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override {
    tell([&](Observer<D>& w) { w.segment(jet, segment); });
  }
  void event(EventKind kind, const Jet<D>& jet) override {
    tell([&](Observer<D>& w) { w.event(kind, jet); });
  }
  void refined(const Jet<D>& jet, const Refinement& refinement) override {
    tell([&](Observer<D>& w) { w.refined(jet, refinement); });
  }
  void finish(const Jet<D>& jet) override {
    tell([&](Observer<D>& w) { w.finish(jet); });
  }

 private:
  template <class F>
  void tell(const F& f) {
    const Working at(Work::output);
    for (Observer<D>* w : all_) f(*w);
  }

  std::vector<Observer<D>*> all_;
};

/// Reads a march that this one takes over.
template <int D>
struct MarchOfAnother {
  March<D>& march;
  std::function<void()> read_beads;
  void visit(Archive& state) { march.take_over(state, read_beads); }
};

}  // namespace

template <int D>
Simulation<D>::Simulation(const Deck& deck, const System<D>& system, const Setting& setting)
    : deck_(deck),
      time_unit_(scales(deck.parameters).time),
      jet_(system.jet),
      nozzle_(system.nozzle),
      decomposition_(system.decomposition),
      setting_{output_setting(setting.outputs, system, setting.resumed),
               setting.stop_request,
               nullptr,
               setting.observables,
               nullptr,
               setting.gather_times,
               setting.mean_over_ranks},
      lock_(setting.outputs.elsewhere
                ? std::optional<DirectoryLock>()
                : std::optional<DirectoryLock>(std::in_place, setting.outputs.directory)),
      checkpoints_(setting.outputs.elsewhere
                       ? std::nullopt
                       : std::optional<Checkpoints>({setting_.outputs.directory, setting_.outputs.existing})),
      outputs_(deck.parameters, system.nozzle, system.collector, setting_.outputs, system.decomposition,
               setting.observables),
      watchers_(std::make_unique<Watchers<D>>(outputs_.observers())),
      integration_(
          deck.parameters, system, {watchers_.get()}, [this] { return stop_here(); },
          [this] {
            if (leaves_state()) keep_state();
          }),
      march_(integration_.march) {
  if (checkpoints_ && setting_.outputs.existing == OutputFile::Existing::replace) checkpoints_->remove();
  if (setting.resumed) {
    visit(setting.resumed->state);
    decomposition_.read(jet_, records_of(*setting.resumed));
  }
  if (setting.steps) {
    MarchOfAnother<D> taken{march_, [&] { decomposition_.read(jet_, records_of(*setting.steps)); }};
    setting.steps->state.part("march", taken);
  }
  if (!setting.outputs.changes.empty()) save();  // what a resumption is to go on with from now on
}

template <int D>
bool Simulation<D>::finish() {
  const bool arrived = march_to_end();
  if (arrived) outputs_.complete(results());
  if (!arrived || !checkpoints_) return arrived;
  saved_before_end_ ? checkpoints_->conclude_with_newest()
                    : checkpoints_->conclude(before_end_ ? &*before_end_ : nullptr);
  return arrived;
}

template <int D>
bool Simulation<D>::march_to_end() {
  const SampledWork work;
  const bool arrived = march_.to(deck_.parameters.final_time / time_unit_);
  work_ = work.seconds();
  return arrived;
}

template <int D>
RunResults Simulation<D>::results() const {
  const Effort& e = march_.effort();
  const GatherTimes t = setting_.gather_times();
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  WorkSeconds of_kinds = work_;
  setting_.mean_over_ranks(of_kinds);
  std::vector<std::pair<std::string, double>> work;
  for (std::size_t k = 0; k < of_kinds.size(); ++k) work.emplace_back(work_names[k], of_kinds[k]);
  return {{{"evaluations", e.evaluations},
           {"steps", e.steps},
           {"rejected", e.rejected},
           {"retaken", e.retaken},
           {"inserted", e.placed},
           {"split", e.split},
           {"merged", e.merged},
           {"arrived", e.removed},
           {"beads", decomposition_.beads(jet_) + jet_.held}},
          {{"compute", seconds - t.exchange - t.wait},
           {"exchange", t.exchange},
           {"wait", t.wait},
           {"gatherings", double(t.count)}},
          work,
          {}};
}

/// All ranks that hold a subdomain are of one opinion.
template <int D>
bool Simulation<D>::leaves_state() const {
  if (decomposition_.in_subdomains()) return !output_files(deck_.parameters).empty();
  return checkpoints_ && outputs_.makes_files();
}

/// A state that the final time has had no influence on, for a run to a later one. A jet in subdomains is
/// nowhere whole but in a file.
template <int D>
void Simulation<D>::keep_state() {
  if (!decomposition_.in_subdomains()) {
    before_end_ = state();
    return;
  }
  save();
  saved_before_end_ = true;
}

template <int D>
bool Simulation<D>::stop_here() {
  const StopRequest stop_request = setting_.stop_request();
  if (stop_request != StopRequest::go_on) save();
  return stop_request == StopRequest::stop;
}

/// Of a jet in subdomains all ranks give theirs to the one that writes.
template <int D>
void Simulation<D>::save() {
  if (saved_before_end_) return;
  const Working at(Work::output);
  if (!checkpoints_) return decomposition_.write(jet_, {});
  // a state that the final time has had an influence on would not do for a later one
  Checkpoint checkpoint = before_end_ ? *before_end_ : state();
  checkpoints_->write(checkpoint, [this](const WriteRecord& write) { decomposition_.write(jet_, write); });
}

template <int D>
Checkpoint Simulation<D>::state() {
  const Provenance& by = setting_.outputs.made_by;
  Checkpoint checkpoint{program(by), deck_.name, deck_.text, deck_.overrides, t(), decomposition_.records(),
                        {},          {}};
  visit(checkpoint.state);
  std::vector<SavedColumn> columns;
  for (const Column& c : setting_.outputs.added) columns.push_back({c.name, c.scale});
  if (!columns.empty()) checkpoint.state.part(columns_part, columns);
  std::string begins_with = by.begins_with, field_map = by.field_map;
  if (!field_map.empty()) {
    std::string place = std::filesystem::absolute(deck_.parameters.field_map).string();
    checkpoint.state.part("field map", field_map);
    checkpoint.state.part(field_map_place, place);
  }
  if (!begins_with.empty()) checkpoint.state.part("begins with", begins_with);
  return checkpoint;
}

template <int D>
void Simulation<D>::visit(CheckpointParts& state) {
  const auto now = Clock::now();
  auto elapsed = now - started_;
  state.part("march", march_);
  state.part("elapsed", elapsed);
  started_ = now - elapsed;
  outputs_.visit(state);
}

template <int D>
double Simulation<D>::t() const {
  return march_.t() * time_unit_;
}

template <int D>
std::string Simulation<D>::summary() const {
  const Effort& e = march_.effort();
  const double seconds = std::chrono::duration<double>(Clock::now() - started_).count();
  std::string text;
  if (decomposition_.beads(jet_) == 0 && t() < deck_.parameters.final_time)
    text = fmt::format("the jet has left at t = {:.10g} s: all beads have arrived, none is inserted\n", t());
  const std::string refined =
      deck_.parameters.refinement ? fmt::format("{} split, {} merged, ", e.split, e.merged) : "";
  text += fmt::format("done in {:.3g} s: {} beads on the jet, {} inserted, {}{} arrived\n", seconds,
                      decomposition_.beads(jet_) + jet_.held, e.placed, refined, e.removed);
  if (nozzle_.inserting()) text += flow_summary();
  text += fmt::format(
      "{} evaluations of the forces in {} steps ({} rejected, {} retaken for an event), {:.3g} us each\n",
      e.evaluations, e.steps, e.rejected, e.retaken, 1e6 * seconds / double(e.evaluations));
  for (const auto& line : outputs_.summary()) text += line + "\n";
  return text;
}

/// What the nozzle has let out and the collector has taken.
template <int D>
std::string Simulation<D>::flow_summary() const {
  const Parameters& p = deck_.parameters;
  const Scales s = scales(p);
  const Effort& e = march_.effort();
  constexpr double hour = 3600, microlitres = 1000, nanoampere = 1e-9;
  const double volume = s.mass / p.density_mass;  // of a bead, cm^3
  const double fed = double(e.released) + (jet_.size() > 0 ? nozzle_.drawn(jet_) - e.drawn : 0);
  const double seconds = t() - e.begun * s.time, beads_a_second = seconds > 0 ? fed / seconds : 0;
  return fmt::format("fed {:.4g} uL, in the mean {:.4g} mL/h and {:.4g} nA{}; {:.4g} uL arrived\n",
                     fed * volume * microlitres, beads_a_second * volume * hour,
                     beads_a_second * s.charge / statcoulomb_per_coulomb / nanoampere,
                     p.feed == Feed::flow ? " as asked for" : ", drawn by the jet",
                     e.arrived * volume * microlitres);
}

template class Simulation<1>;
template class Simulation<3>;

}  // namespace treejet
