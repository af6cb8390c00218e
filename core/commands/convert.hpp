#pragma once
/// `treejet convert`: traj.h5 into the formats of other tools (core/io/frame_writer.hpp).

#include "core/base/output_file.hpp"

namespace treejet {

struct Conversion {
  std::filesystem::path from;
  std::string to;             ///< the name of a format
  std::filesystem::path out;  ///< empty: beside `from`, with the extension of the format
  OutputFile::Existing existing = OutputFile::Existing::keep;
};

/// Returns a line that tells what was written.
std::string convert(const Conversion& conversion);

}  // namespace treejet
