#include "core/commands/convert.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/io/frame_writer.hpp"
#include "core/io/h5md.hpp"

namespace treejet {

std::string convert(const Conversion& c) {
  std::error_code error;
  if (!std::filesystem::exists(c.from, error))
    throw FileError(fmt::format("{}: no such file", c.from.string()));
  if (!is_hdf5(c.from))
    throw FileError(fmt::format("{}: no HDF5 file; expected the traj.h5 of a run", c.from.string()));
  const H5md file(c.from, Hdf5File::Access::read);
  const auto format = std::find_if(frame_formats.begin(), frame_formats.end(),
                                   [&](const FrameFormat& f) { return c.to == f.name; });
  if (format == frame_formats.end()) throw InputError(fmt::format("--to {}: no such format", c.to));
  std::filesystem::path out = c.out;
  if (out.empty()) out = std::filesystem::path(c.from).replace_extension(format->extension);
  if (std::filesystem::equivalent(out, c.from, error))
    throw FileError(fmt::format("{}: holds the trajectory; choose another file with --out", out.string()));

  const auto writer =
      format->writer({out, c.existing, program(file.content().made_by), file.points(), file.columns()});
  constexpr std::uint64_t most_frames = 64, most_points = 1 << 20;  // in memory
  const std::uint64_t at_once = std::clamp<std::uint64_t>(most_points / (file.points() + 1), 1, most_frames);
  for (std::uint64_t i = 0; i < file.frames(); i += at_once)
    for (const Frame& frame : file.frames(i, std::min(at_once, file.frames() - i))) writer->write(frame);
  writer->finish();
  return fmt::format("{}: {} frames", out.string(), file.frames());
}

}  // namespace treejet
