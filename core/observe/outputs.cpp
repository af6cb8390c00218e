#include "core/observe/outputs.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/io/output_files.hpp"
#include "core/jet/schemes.hpp"
#include "core/observe/accuracy_warning.hpp"
#include "core/observe/output_hdf5.hpp"
#include "core/observe/output_table.hpp"
#include "core/observe/output_xyz.hpp"
#include "core/observe/plausibility.hpp"
#include "core/observe/progress.hpp"
#include "core/observe/recorder.hpp"
#include "core/observe/steady_mean.hpp"
#include "core/observe/step_errors.hpp"
#include "core/restart/checkpoint.hpp"

namespace treejet {

namespace {

template <int D>
std::unique_ptr<Recorder<D>> recorder(const Parameters& p, const Nozzle<D>& nozzle,
                                      const Collector& collector, const OutputSetting& setting) {
  return std::make_unique<Recorder<D>>(
      Recorder<D>::setting(p, nozzle, collector, setting.force_error, setting.added));
}

/// The rows of traj.h5: the time, and what else `print list` asks for.
std::vector<std::string> after_time(std::vector<std::string> keys) {
  keys.insert(keys.begin(), "t");
  return keys;
}

bool makes_table(const Parameters& p, const OutputSetting& setting) {
  // a run stopped quietly may not have kept the windows of a table
  return !p.print_list.empty() && !setting.quiet && (!setting.resumed || setting.resumed->has("rows"));
}

std::vector<std::string> hdf5_observables(const Parameters& p) {
  return p.print_hdf5 ? reproducible_keys(p.print_list) : std::vector<std::string>();
}

/// All ranks must be of one opinion: who makes no rows here contributes to them.
bool makes_rows(const Parameters& p, const OutputSetting& setting) {
  return makes_table(p, setting) || !p.printstat_list.empty() || !hdf5_observables(p).empty();
}

/// All files are looked for before the first is made. A link that leads nowhere is there, too.
void expect_absent(const Parameters& p, const std::filesystem::path& directory) {
  for (const OutputFileKind& file : output_files(p)) {
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(directory / file.name, error)))
      throw exists_already(directory / file.name);
  }
}

/// White noise has no slope that its change is the integral of.
bool has_step_errors(const Parameters& p) {
  return !properties(p.integrator).adaptive && p.integrator != Scheme::sra1;
}

/// Sends its subdomain of what another rank writes: the oldest `most` beads.
template <int D>
class Contribution final : public Sampling<D> {
 public:
  Contribution(double interval, std::int64_t most) : Sampling<D>(interval), most_(most) {}

 private:
  void sample(const Jet<D>& jet) override {
    this->decomposition().in_portions(jet, most_, [](const Jet<D>&) {});
  }

  std::int64_t most_;
};

/// The keys of both tables that have a mean, time first.
std::vector<std::string> keys_with_means(const Parameters& p) {
  std::vector<std::string> keys = p.printstat_list;
  keys.insert(keys.end(), p.print_list.begin(), p.print_list.end());
  return treejet::keys_with_means(keys);
}

}  // namespace

template <int D>
Outputs<D>::Outputs(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                    const OutputSetting& setting, const Decomposition<D>& decomposition,
                    const OwnObservables<D>& own)
    : maxnum_(p.xyz_maxnum), force_error_(setting.force_error) {
  if (setting.elsewhere) {
    contributes_ = true;
    contribute(p, nozzle, collector, setting, decomposition);
    return;
  }
  if (setting.existing == OutputFile::Existing::keep) expect_absent(p, setting.directory);
  const Scales s = scales(p);
  const auto file = [&](const char* name) {
    files_.push_back(setting.directory / name);
    return OutputFile(files_.back(), setting.existing);
  };
  const std::shared_ptr<H5mdTrajectory> hdf5 = p.print_hdf5 ? trajectory_file(p, setting, own) : nullptr;
  if (makes_rows(p, setting)) {
    auto rows = recorder<D>(p, nozzle, collector, setting);
    rows->add(p.print_list,
              makes_table(p, setting) ? std::make_unique<TerminalTable>(labels(p.print_list, own)) : nullptr,
              own);
    if (!p.printstat_list.empty()) {
      rows->add(p.printstat_list,
                std::make_unique<StatFile>(file("statdat.dat"), labels(p.printstat_list, own),
                                           setting.made_by, setting.changes),
                own);
    }
    if (const auto keys = hdf5_observables(p); !keys.empty())
      rows->add(after_time(keys), std::make_unique<Hdf5Rows>(hdf5), own);
    means_ = std::make_shared<SteadyMeans>(labels(keys_with_means(p), own));
    rows->add(keys_with_means(p), means_, own);
    watch("rows", std::move(rows), decomposition);
  }
  if (p.print_xyz) {
    auto trajectory = std::make_unique<XyzTrajectory<D>>(
        typename XyzTrajectory<D>::Setting{nozzle, s, *p.print_xyz / s.time, p.xyz_maxnum, p.xyz_rescale,
                                           program(setting.made_by)},
        file("traj.xyz"));
    trajectory_ = &watch("traj.xyz", std::move(trajectory), decomposition);
  }
  if (hdf5) {
    using Frames = Hdf5Trajectory<D>;
    const typename Frames::Setting frames{
        nozzle, s, p.nozzle_cross, *p.print_hdf5 / s.time, {viscous_stress(p), setting.added, drying(p)}};
    watch("traj.h5", std::make_unique<Frames>(frames, hdf5), decomposition);
  }
  if (!files_.empty()) keep_record(setting);
  look_for_trouble(p, nozzle, collector, decomposition);
  if (!setting.quiet) {
    watchers_.push_back({"", std::make_unique<Progress<D>>(p.final_time / s.time, s.time,
                                                           stderr_is_interactive(), decomposition)});
  }
}

template <int D>
void Outputs<D>::look_for_trouble(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                                  const Decomposition<D>& decomposition) {
  const double time_unit = scales(p).time;
  if (force_error_)
    watchers_.push_back({"accuracy", std::make_unique<AccuracyWarning<D>>(*force_error_, time_unit)});
  if (has_step_errors(p)) {
    auto errors = std::make_unique<StepErrors<D>>(nozzle, collector, event_rule(p), time_unit, decomposition);
    step_errors_ = errors.get();
    watchers_.push_back({"fixed step", std::move(errors)});
  }
  watchers_.push_back({"plausibility", std::make_unique<Plausibility<D>>(p, nozzle)});
}

template <int D>
template <class Samples>
Samples& Outputs<D>::watch(const std::string& name, std::unique_ptr<Samples> watcher,
                           const Decomposition<D>& decomposition) {
  Samples& watching = *watcher;
  watching.sample_all(decomposition);
  watchers_.push_back({name, std::move(watcher)});
  return watching;
}

/// What another rank writes of all subdomains, this one gives its own to, in the same order.
template <int D>
void Outputs<D>::contribute(const Parameters& p, const Nozzle<D>& nozzle, const Collector& collector,
                            const OutputSetting& setting, const Decomposition<D>& decomposition) {
  if (!decomposition.in_subdomains()) return;
  const Scales s = scales(p);
  if (makes_rows(p, setting)) {
    auto rows = recorder<D>(p, nozzle, collector, setting);
    rows->add(p.print_list, nullptr);
    rows->add(p.printstat_list, nullptr);
    watch("rows", std::move(rows), decomposition);
  }
  const auto contribution = [&](const char* name, double interval, std::int64_t most) {
    watch(name, std::make_unique<Contribution<D>>(interval / s.time, most), decomposition);
  };
  if (p.print_xyz) contribution("traj.xyz", *p.print_xyz, p.xyz_maxnum);
  if (p.print_hdf5) contribution("traj.h5", *p.print_hdf5, std::numeric_limits<std::int64_t>::max());
  if (has_step_errors(p))
    watchers_.push_back(
        {"fixed step", std::make_unique<StepErrors<D>>(nozzle, collector, event_rule(p), s.time,
                                                       decomposition, /*silent*/ true)});
}

template <int D>
std::shared_ptr<H5mdTrajectory> Outputs<D>::trajectory_file(const Parameters& p, const OutputSetting& setting,
                                                            const OwnObservables<D>& own) {
  const auto path = setting.directory / "traj.h5";
  files_.insert(files_.end(), {path, setting.directory / "traj.xdmf"});
  H5md::Content content{setting.made_by, hdf5_observables(p), frame_columns_of(setting.added)};
  if (!content.keys.empty())
    for (const auto& o : own) {
      content.keys.push_back(o.key);
      content.units[o.key] = o.unit;
    }
  return std::make_shared<H5mdTrajectory>(path, std::move(content), setting.existing, setting.chunks_shared);
}

template <int D>
void Outputs<D>::keep_record(const OutputSetting& setting) {
  RunRecord::Setting record{setting.directory, setting.made_by, {}, setting.circumstances, setting.existing};
  for (const auto& f : files_) record.files.push_back(f.filename().string());
  record_ = std::make_unique<RunRecord>(record);
  files_.push_back(setting.directory / run_record_name);
}

template <int D>
Outputs<D>::~Outputs() = default;

template <int D>
std::vector<Observer<D>*> Outputs<D>::observers() const {
  std::vector<Observer<D>*> all;
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
  if (force_error_) lines.push_back(summary_of(*force_error_));
  if (step_errors_) lines.push_back(step_errors_->summary());
  if (means_)
    for (auto& line : description(means_->means())) lines.push_back(std::move(line));
  return lines;
}

template <int D>
void Outputs<D>::complete(RunResults results) {
  if (!record_) return;
  if (means_) results.means = means_->means();
  if (step_errors_) results.fixed_step = step_errors_->results();
  record_->complete(results);
}

template <int D>
void Outputs<D>::visit(CheckpointParts& state) {
  for (auto& w : watchers_) {
    if (w.name.empty()) continue;
    contributes_ ? state.beginning_of_part(w.name, *w.watcher) : state.part(w.name, *w.watcher);
  }
}

template class Outputs<1>;
template class Outputs<3>;

}  // namespace treejet
