#include "integrators/run/simulation.hpp"

#include <fmt/format.h>

#include "core/jet/scales.hpp"

namespace treejet {

namespace {

OutputSetting output_setting(OutputSetting outputs, const Columns& added, const Checkpoint* resumed) {
  outputs.added = added;
  if (resumed) {
    outputs.existing = OutputFile::Existing::resume;
    outputs.resumed = &resumed->state;
  }
  return outputs;
}

}  // namespace

template <int D>
Simulation<D>::Simulation(const Deck& deck, const System<D>& system, const Setting& setting)
    : deck_(deck),
      time_unit_(scales(deck.parameters).time),
      jet_(system.jet),
      nozzle_(system.nozzle),
      decomposition_(system.decomposition),
      setting_{output_setting(setting.outputs, system.columns, setting.resumed), setting.stop_request,
               nullptr, setting.observables},
      lock_(setting.outputs.elsewhere
                ? std::optional<DirectoryLock>()
                : std::optional<DirectoryLock>(std::in_place, setting.outputs.directory)),
      checkpoints_(setting.outputs.elsewhere
                       ? std::nullopt
                       : std::optional<Checkpoints>({setting_.outputs.directory, setting_.outputs.existing})),
      outputs_(deck.parameters, system.nozzle, system.collector, setting_.outputs, system.decomposition,
               setting.observables),
      integration_(deck.parameters, system, outputs_.observers(), [this] { return stop_here(); }),
      march_(integration_.march) {
  if (checkpoints_ && setting_.outputs.existing == OutputFile::Existing::replace) checkpoints_->remove();
  if (!setting.resumed) return;
  visit(setting.resumed->state);
  decomposition_.read(jet_, records_of(*setting.resumed));
}

template <int D>
bool Simulation<D>::finish() {
  const bool arrived = march_.to(deck_.parameters.final_time / time_unit_);
  if (arrived && checkpoints_) checkpoints_->remove();
  return arrived;
}

template <int D>
bool Simulation<D>::stop_here() {
  const StopRequest stop_request = setting_.stop_request();
  if (stop_request != StopRequest::go_on) save();
  return stop_request == StopRequest::stop;
}

/// Of a jet in pieces all ranks give theirs to the one that writes.
template <int D>
void Simulation<D>::save() {
  if (!checkpoints_) return decomposition_.write(jet_, {});
  Checkpoint checkpoint{program(setting_.outputs.made_by), deck_.name, deck_.text, deck_.overrides, t(),
                        decomposition_.records(),          {},         {}};
  visit(checkpoint.state);
  checkpoints_->write(checkpoint, [this](const WriteRecord& write) { decomposition_.write(jet_, write); });
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
  text += fmt::format("done in {:.3g} s: {} beads on the jet, {} inserted, {} arrived\n", seconds,
                      decomposition_.beads(jet_) + jet_.held, e.placed, e.removed);
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
  const double fed = double(e.released) + (jet_.size() > 0 ? nozzle_.drawn(jet_) - 1 : 0);
  const double beads_a_second = t() > 0 ? fed / t() : 0;
  return fmt::format("fed {:.4g} uL, in the mean {:.4g} mL/h and {:.4g} nA{}; {:.4g} uL arrived\n",
                     fed * volume * microlitres, beads_a_second * volume * hour,
                     beads_a_second * s.charge / statcoulomb_per_coulomb / nanoampere,
                     p.feed == Feed::flow ? " as asked for" : ", drawn by the jet",
                     double(e.removed) * volume * microlitres);
}

template class Simulation<1>;
template class Simulation<3>;

}  // namespace treejet
