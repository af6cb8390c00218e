#pragma once
/// The description of traj.h5 that ParaView and VisIt read (XDMF 2): a series of grids in time, each a
/// polyline along the jet, from the oldest bead to the nozzle, with the columns of core/io/frame.hpp on its
/// points.

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/frame.hpp"

namespace treejet {

class Xdmf {
 public:
  struct Grid {
    double time;
    std::uint64_t points;
  };

  void add(const Grid& grid) { grids_.push_back(grid); }

  /// The text, for values that have `width` points a frame in each of the columns.
  std::string text(const std::string& hdf5_name, std::uint64_t width, const FrameColumns& columns) const;

 private:
  std::vector<Grid> grids_;
};

}  // namespace treejet
