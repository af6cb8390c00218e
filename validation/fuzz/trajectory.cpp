/// traj.h5, read frame by frame, as a whole, as the origin of a run, and by a run that goes on writing it.

#include <fmt/format.h>

#include <algorithm>

#include "core/commands/convert.hpp"
#include "core/commands/file_info.hpp"
#include "core/io/h5md_trajectory.hpp"
#include "core/restart/origin.hpp"
#include "validation/fuzz/target.hpp"

namespace treejet::fuzz {

namespace {

void check(const Frame& f, const FrameColumns& columns, std::uint64_t most) {
  demand(f.points() <= most, "no frame is larger than the largest");
  demand(f.columns.size() == columns.size(), "a frame has all columns");
  for (std::size_t c = 0; c < columns.size(); ++c)
    demand(f.columns[c].size() == f.points() * static_cast<std::size_t>(columns[c].width),
           "a column has the values of all points");
}

void read_frames(const H5md& file) {
  const std::vector<double> times = file.times();
  demand(times.size() == file.frames(), "each frame has a time");
  const std::uint64_t most = std::min<std::uint64_t>(file.frames(), 4);
  for (std::uint64_t k = 0; k < most; ++k) {
    const Frame whole = file.frames(k, 1).front(), part = file.part(k, 0, 3);
    check(whole, file.columns(), file.points());
    check(part, file.columns(), 3);
    const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
    demand(same(whole.time, times[k]) && same(part.time, times[k]), "a frame has its time");
  }
  for (const Row& row : file.rows(0, file.rows()))
    demand(row.values.size() == file.content().keys.size(), "a row has all observables");
}

void take_as_origin(const std::filesystem::path& file) {
  const Origin o = origin(file.string());
  Parameters p = o.deck.parameters;
  p.final_time = 1e9;
  const auto begin = [&](const auto& jet) {
    demand(jet.size() > 0 && jet.y.allFinite(), "the beads are somewhere");
    demand(jet.mass.size() == jet.size(), "each bead has a mass");
  };
  p.system == 1 ? begin(jet_of<1>(o, p)) : begin(jet_of<3>(o, p));
}

void go_on(const std::filesystem::path& file) {
  H5md::Content content;
  std::uint64_t frames = 0, rows = 0;
  {
    const H5md there(file, Hdf5File::Access::read);
    content = there.content();
    frames = std::min<std::uint64_t>(there.frames(), 3), rows = std::min<std::uint64_t>(there.rows(), 3);
  }
  H5mdTrajectory trajectory(file, content, OutputFile::Existing::resume);
  trajectory.continue_from(frames, rows);
}

}  // namespace

std::vector<std::string> trajectories() {
  return files_of_runs("traj.h5");
}

void feed_trajectory(std::string_view bytes) {
  const auto& file = as_file(bytes);
  is_read([&] { file_info(file); });
  if (!is_read([&] { read_frames(H5md(file, Hdf5File::Access::read)); })) return;
  is_read([&] { take_as_origin(file); });
  const auto out = file.parent_path() / "converted";
  is_read([&] { convert({file, "csv", out, OutputFile::Existing::replace}); });
  is_read([&] { go_on(file); });
}

}  // namespace treejet::fuzz
