#include "core/observe/recorder.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/deck/observable_keys.hpp"

namespace treejet {

template <int D>
typename Recorder<D>::Setting Recorder<D>::setting(const Parameters& p, const Nozzle<D>& nozzle,
                                                   const Collector& collector,
                                                   const FieldErrorReport* force_error,
                                                   const Columns& added) {
  const Scales s = scales(p);
  return {nozzle,
          collector,
          s,
          p.nozzle_cross,
          p.collector_distance,
          print_interval(p) / s.time,
          p.final_time / s.time,
          force_error,
          {viscous_stress(p), added, drying(p)}};
}

template <int D>
Recorder<D>::Recorder(const Setting& setting)
    : Sampling<D>(setting.interval),
      setting_(setting),
      statistics_(setting.nozzle, setting.collector, setting.material) {
  this->sample_early_end();
}

template <int D>
void Recorder<D>::add(const std::vector<std::string>& keys, std::shared_ptr<RowSink> sink,
                      const OwnObservables<D>& own) {
  List list{{}, std::move(sink)};
  for (const auto& key : keys) {
    list.observables.push_back(observable<D>(key));
    if (has(key, along_path)) statistics_.follow_path();
  }
  for (const auto& o : own)
    list.observables.push_back([value = o.value](const View<D>& view) { return value(view.jet); });
  lists_.push_back(std::move(list));
}

template <int D>
void Recorder<D>::start(const Jet<D>& jet) {
  started_ = last_row_ = Clock::now();
  statistics_.start(jet);
  fed_ = statistics_.charge_fed(jet);
  landed_ = statistics_.charge_landed(jet);
  Sampling<D>::start(jet);
}

template <int D>
void Recorder<D>::segment(const Jet<D>& jet, const DenseOutput<D>& segment) {
  Sampling<D>::segment(jet, segment);
  statistics_.integrate(segment, segment.until, this->decomposition());
}

template <int D>
void Recorder<D>::finish(const Jet<D>& jet) {
  Sampling<D>::finish(jet);
  for (auto& list : lists_)
    if (list.sink) list.sink->finish();
}

template <int D>
void Recorder<D>::visit(Archive& state) {
  const auto now = Clock::now();
  auto elapsed = now - started_, in_window = now - last_row_;
  Sampling<D>::visit(state);
  state(statistics_, fed_, landed_, remarked_, elapsed, in_window);
  started_ = now - elapsed;
  last_row_ = now - in_window;
  for (auto& list : lists_)
    if (list.sink) list.sink->visit(state);
}

template <int D>
Timing Recorder<D>::timing(double t) const {
  const auto now = Clock::now();
  const double interval = std::chrono::duration<double>(now - last_row_).count();
  const double rows_left = (setting_.end - t) / setting_.interval;
  return {interval, std::chrono::duration<double>(now - started_).count(), interval * rows_left};
}

/// The time average over the window; at the start, before any window, the path now.
template <int D>
double Recorder<D>::mean_path(const Jet<D>& jet) const {
  if (!statistics_.follows_path()) return std::numeric_limits<double>::quiet_NaN();
  const Window& w = statistics_.window();
  const double length = jet.t - w.begin;
  return length > 0 ? w.path_length / length
                    : this->decomposition().path_length(jet.y, setting_.nozzle.position(jet.t));
}

/// The rows that follow say how their forces are computed whenever that has changed.
template <int D>
void Recorder<D>::remark_on_forces(const Jet<D>& jet) {
  const FieldErrorReport& forces = *setting_.force_error;
  if (forces.method == remarked_) return;
  remarked_ = forces.method;
  const std::string remark = fmt::format("t = {:.6g} s, {} beads: {}", jet.t * setting_.scales.time,
                                         this->decomposition().beads(jet), forces.method);
  for (auto& list : lists_)
    if (list.sink) list.sink->remark(remark);
}

template <int D>
void Recorder<D>::sample(const Jet<D>& jet) {
  const double fed = statistics_.charge_fed(jet), landed = statistics_.charge_landed(jet);
  const View<D> view{jet,
                     this->decomposition().beads(jet),
                     mean_path(jet),
                     setting_.nozzle,
                     statistics_.window(),
                     setting_.scales,
                     setting_.nozzle_radius,
                     setting_.collector_distance,
                     fed - fed_,
                     landed - landed_,
                     statistics_.splits(),
                     statistics_.merges(),
                     timing(jet.t),
                     setting_.force_error,
                     setting_.material};
  if (setting_.force_error) remark_on_forces(jet);
  std::vector<double> values;
  for (auto& list : lists_) {
    if (!list.sink) continue;
    values.clear();
    for (const auto& o : list.observables) values.push_back(o(view));
    list.sink->row(values);
  }
  fed_ = fed;
  landed_ = landed;
  last_row_ = Clock::now();
  statistics_.begin_window(jet.t);
}

template class Recorder<1>;
template class Recorder<3>;

}  // namespace treejet
