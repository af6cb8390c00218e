#pragma once
/// traj.xyz: the trajectory for VMD, OVITO and the like, in centimetres (times `print xyz rescale`).
///
/// A frame: the number of lines that follow (`print xyz maxnum`, constant); a comment `t = <s> s  beads =
/// <real lines>`, in a frame at t = 0 also `program="..." record="run.json"`; lines `C x y z`, oldest bead
/// first, the nozzle last, then padding at the origin. With more beads than maxnum the ones nearest to the
/// collector are kept.

#include <algorithm>
#include <string>

#include "core/base/output_file.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/scales.hpp"
#include "core/observe/sampling.hpp"

namespace treejet {

template <int D>
class XyzTrajectory final : public Sampling<D> {
 public:
  struct Setting {
    const Nozzle<D>& nozzle;
    Scales scales;
    double interval;  ///< scaled
    int maxnum;
    double rescale;
    std::string made_by;  ///< told at t = 0; VMD reads comments of up to 1023 characters
  };

  XyzTrajectory(const Setting& setting, OutputFile file)
      : Sampling<D>(setting.interval), setting_(setting), file_(std::move(file)) {}

  /// The most beads (nozzle counted) a frame had to hold.
  Eigen::Index most_beads() const { return most_; }

  void finish(const Jet<D>& jet) override {
    Sampling<D>::finish(jet);
    file_.sync();
  }

  void visit(Archive& state) override {
    Sampling<D>::visit(state);
    state(file_, most_);
  }

 protected:
  void sample(const Jet<D>& jet) override;

 private:
  Setting setting_;
  OutputFile file_;
  Eigen::Index most_ = 0;
};

}  // namespace treejet
