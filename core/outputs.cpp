#include "core/outputs.hpp"

#include <fmt/format.h>

#include "core/accuracy_warning.hpp"
#include "core/output_table.hpp"
#include "core/output_xyz.hpp"
#include "core/progress.hpp"
#include "core/recorder.hpp"

namespace treejet {

namespace {

template <int D>
std::unique_ptr<Recorder<D>> recorder(const Parameters& p, const Nozzle<D>& nozzle,
                                      const Collector& collector, const ForceError* force_error) {
  const Scales s = scales(p);
  return std::make_unique<Recorder<D>>(
      typename Recorder<D>::Setting{nozzle, collector, s, p.nozzle_cross, p.collector_distance,
                                    print_interval(p) / s.time, p.final_time / s.time, force_error});
}

}  // namespace

template <int D>
Outputs<D>::Outputs(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                    const OutputSetting& setting)
    : maxnum_(p.xyz_maxnum), force_error_(setting.force_error) {
  const Scales s = scales(p);
  const bool table = !p.print_list.empty() && !setting.quiet;
  const auto file = [&](const char* name) {
    files_.push_back(setting.directory / name);
    return OutputFile(files_.back(), setting.existing);
  };
  if (table || !p.printstat_list.empty()) {
    auto rows = recorder<D>(p, nozzle, collector, setting.force_error);
    if (table) rows->add(p.print_list, std::make_unique<TerminalTable>(p.print_list));
    if (!p.printstat_list.empty()) {
      rows->add(p.printstat_list, std::make_unique<StatFile>(file("statdat.dat"), p.printstat_list));
    }
    watchers_.push_back(std::move(rows));
  }
  if (p.print_xyz) {
    auto trajectory = std::make_unique<Trajectory<D>>(
        typename Trajectory<D>::Setting{nozzle, s, *p.print_xyz / s.time, p.xyz_maxnum, p.xyz_rescale},
        file("traj.xyz"));
    trajectory_ = trajectory.get();
    watchers_.push_back(std::move(trajectory));
  }
  if (force_error_) watchers_.push_back(std::make_unique<AccuracyWarning<D>>(*force_error_, s.time));
  if (!setting.quiet) {
    watchers_.push_back(
        std::make_unique<Progress<D>>(p.final_time / s.time, s.time, stderr_is_interactive()));
  }
}

template <int D>
Outputs<D>::~Outputs() = default;

template <int D>
std::vector<Watcher<D>*> Outputs<D>::watchers() const {
  std::vector<Watcher<D>*> all;
  for (auto& w : watchers_) all.push_back(w.get());
  return all;
}

template <int D>
std::vector<std::string> Outputs<D>::summary() const {
  std::vector<std::string> lines;
  for (auto& f : files_) {
    std::error_code error;
    lines.push_back(fmt::format("{}  {} kB", f.string(), std::filesystem::file_size(f, error) / 1024));
  }
  if (trajectory_ && trajectory_->most_beads() > maxnum_) {
    lines.push_back(
        fmt::format("traj.xyz leaves out the beads nearest to the nozzle: {} points, print xyz maxnum {}",
                    trajectory_->most_beads(), maxnum_));
  }
  if (force_error_) lines.push_back(summary_of(*force_error_));
  return lines;
}

template class Outputs<1>;
template class Outputs<3>;

}  // namespace treejet
