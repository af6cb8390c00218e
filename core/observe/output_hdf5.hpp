#pragma once
/// traj.h5 as a run sees it: frames every `print hdf5`, and the rows of the `print list` observables every
/// `print time`. Wall-clock observables are left out: the file is a function of the run.

#include <functional>
#include <limits>
#include <memory>

#include "core/io/h5md_trajectory.hpp"
#include "core/observe/recorder.hpp"

namespace treejet {

/// Takes its frames; the file's last word.
template <int D>
class Hdf5Trajectory final : public Sampling<D> {
 public:
  struct Setting {
    const Nozzle<D>& nozzle;
    Scales scales;
    double nozzle_radius;  ///< cm
    double interval;       ///< scaled
    Material material = {};
  };

  Hdf5Trajectory(const Setting& setting, std::shared_ptr<H5mdTrajectory> file)
      : Sampling<D>(setting.interval), setting_(setting), file_(std::move(file)) {}

  void finish(const Jet<D>& jet) override {
    Sampling<D>::finish(jet);
    file_->finish();
  }

  void visit(Archive& state) override {
    Sampling<D>::visit(state);
    if (!state.reading()) file_->sync();
    std::uint64_t frames = file_->frames(), rows = file_->rows();
    state(frames, rows);
    if (state.reading()) file_->continue_from(frames, rows);
  }

 protected:
  void sample(const Jet<D>& jet) override {
    const Decomposition<D>& all = this->decomposition();
    if (!all.in_subdomains()) return file_->append(part(jet));
    const auto points = static_cast<std::uint64_t>(all.beads(jet)) + 1;
    file_->append(jet.t * setting_.scales.time, points, [&](const auto& take) { give(jet, take); });
  }

 private:
  Frame part(const Jet<D>& some, bool to_nozzle = true) const {
    return frame<D>(some, setting_.nozzle, setting_.scales, setting_.nozzle_radius, setting_.material,
                    to_nozzle);
  }

  /// The parts of a frame, each when the next is there, whose first bead its youngest element ends at.
  void give(const Jet<D>& jet, const std::function<void(const Frame&)>& take) const {
    Jet<D> last = at<D>(jet, jet.t, jet.y.topRows(0));
    constexpr auto all = std::numeric_limits<std::int64_t>::max();
    this->decomposition().in_portions(jet, all, [&](const Jet<D>& some) {
      if (const Eigen::Index n = last.size(); n > 0) {
        last.y.conservativeResize(n + 1, Eigen::NoChange);
        last.y.row(n) = some.y.row(0);
        take(part(last, /*to_nozzle*/ false));
      }
      last = some;
    });
    take(part(last));
  }

  Setting setting_;
  std::shared_ptr<H5mdTrajectory> file_;
};

/// Takes its rows, which begin with the time.
class Hdf5Rows final : public RowSink {
 public:
  explicit Hdf5Rows(std::shared_ptr<H5mdTrajectory> file) : file_(std::move(file)) {}
  void row(const std::vector<double>& values) override {
    file_->append(Row{0, values.at(0), {values.begin() + 1, values.end()}});
  }

 private:
  std::shared_ptr<H5mdTrajectory> file_;
};

/// The keys that a file of the same run always has the same values for, each once.
std::vector<std::string> reproducible_keys(const std::vector<std::string>& keys);

}  // namespace treejet
