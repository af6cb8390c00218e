#pragma once
/// Frames in the formats of other tools; what `treejet convert` writes. Lengths stay in cm, all else in CGS,
/// numbers are written so that reading gives them back to the last bit.
///
///     xyz      lines `C x y z`, padded with `C 0 0 0` to the points of the largest frame as print xyz does:
///              VMD and MDAnalysis take the number of the first frame for that of all, without a word
///
///     extxyz   extended XYZ: species (C a bead, X the nozzle), pos, id, velo, and tension, bead_charge,
///              bead_mass, jet_radius, names that ASE and OVITO keep as they are, and
///              columns that the scene has added under their own: they take stress for the
///              cell's, mass and charge for the atoms', radius for the size of a ball
///
///     csv      a header with units, then a row a point: `frame,t[s],id,x[cm],...`
///
///     vtp      NAME.pvd and the files of its frames in NAME-frames/, a polyline each
///
/// The XML of VTK is written by hand: the library that would do it is larger than this program by two orders.

#include <memory>

#include "core/base/output_file.hpp"
#include "core/io/frame.hpp"

namespace treejet {

class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  virtual void write(const Frame& frame) = 0;
  virtual void finish() {}
};

struct FrameWriterSetting {
  std::filesystem::path out;
  OutputFile::Existing existing = OutputFile::Existing::keep;
  std::string made_by;            ///< a line
  std::uint64_t most_points = 0;  ///< of the largest frame
  FrameColumns columns = frame_columns();
};

/// Formats, in the order above.
struct FrameFormat {
  const char* name;
  const char* extension;  ///< of its file
  const char* readers;    ///< programs it is for
  std::unique_ptr<FrameWriter> (*writer)(const FrameWriterSetting&);
};
extern const std::array<FrameFormat, 4> frame_formats;

std::unique_ptr<FrameWriter> vtp_writer(const FrameWriterSetting& setting);

}  // namespace treejet
