#include "core/outputs.hpp"

#include <fmt/format.h>

#include "core/checkpoint.hpp"
#include "core/output_table.hpp"
#include "core/output_xyz.hpp"
#include "core/progress.hpp"
#include "core/recorder.hpp"

namespace treejet {

namespace {

template <int D>
std::unique_ptr<Recorder<D>> recorder(const Parameters& p, const Nozzle<D>& nozzle,
                                      const Collector& collector) {
  const Scales s = scales(p);
  return std::make_unique<Recorder<D>>(
      typename Recorder<D>::Setting{nozzle, collector, s, p.nozzle_cross, p.collector_distance,
                                    print_interval(p) / s.time, p.final_time / s.time});
}

}  // namespace

template <int D>
Outputs<D>::Outputs(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                    const OutputSetting& setting)
    : maxnum_(p.xyz_maxnum) {
  if (setting.elsewhere) return;
  const Scales s = scales(p);
  const auto file = [&](const char* name) {
    files_.push_back(setting.directory / name);
    return OutputFile(files_.back(), setting.existing);
  };
  if (!p.print_list.empty() || !p.printstat_list.empty()) {
    auto rows = recorder<D>(p, nozzle, collector);
    // quiet or not, the windows are the same: a run may be resumed either way
    rows->add(p.print_list, setting.quiet ? nullptr : std::make_unique<TerminalTable>(p.print_list));
    if (!p.printstat_list.empty()) {
      rows->add(p.printstat_list, std::make_unique<StatFile>(file("statdat.dat"), p.printstat_list));
    }
    watchers_.push_back({"rows", std::move(rows)});
  }
  if (p.print_xyz) {
    auto trajectory = std::make_unique<Trajectory<D>>(
        typename Trajectory<D>::Setting{nozzle, s, *p.print_xyz / s.time, p.xyz_maxnum, p.xyz_rescale},
        file("traj.xyz"));
    trajectory_ = trajectory.get();
    watchers_.push_back({"traj.xyz", std::move(trajectory)});
  }
  if (!setting.quiet) {
    watchers_.push_back(
        {"progress", std::make_unique<Progress<D>>(p.final_time / s.time, s.time, stderr_is_interactive())});
  }
}

template <int D>
Outputs<D>::~Outputs() = default;

template <int D>
std::vector<Watcher<D>*> Outputs<D>::watchers() const {
  std::vector<Watcher<D>*> all;
  for (auto& w : watchers_) all.push_back(w.watcher.get());
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
  return lines;
}

template <int D>
void Outputs<D>::visit(State& state) {
  for (auto& w : watchers_) state.part(w.name, *w.watcher);
}

template class Outputs<1>;
template class Outputs<3>;

}  // namespace treejet
