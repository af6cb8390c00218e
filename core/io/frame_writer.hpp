#pragma once
/// Frames in the formats of other tools; what `treejet convert` writes. Lengths stay in cm, all else in CGS,
/// numbers are written so that reading gives them back to the last bit.
///
///     xyz      lines `C x y z`, as many a frame as there are points
///
///     extxyz   extended XYZ: id, species (C a bead, X the nozzle), pos, velocity, stress and so on
///
///     csv      a header with units, then a row a point: `frame,t[s],id,x[cm],...`
///
///     vtp      NAME.pvd and the files of its frames in NAME-frames/, a polyline each
///
/// The XML of VTK is written by hand: the library that would do it is larger than this program by two orders.

#include <memory>

#include "core/io/frame.hpp"
#include "core/io/output_file.hpp"

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
  std::string made_by;  ///< a line
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
