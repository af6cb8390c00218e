#include "core/io/h5md_trajectory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {

/// While the file grows a chunk is of one frame, and not compressed: it is written twice, and a third time in
/// the end. Small ones waste little on short jets; of a long one they would be so many that HDF5 took longer
/// to find them than to write them.
H5md::Chunk growing_chunk(std::uint64_t points) {
  return {1, points_of_growing_chunk(points), /*compressed*/ false};
}
constexpr std::size_t most_pending = 256;               ///< frames in memory
constexpr std::size_t most_pending_points = 1'000'000;  ///< of them together
constexpr int flush_share = 50;                         ///< a flush takes at most this part of the time

/// Whether someone has the file open: HDF5 locks what it reads.
bool in_use(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

/// The chunks of the final form, of about 64 kB a component: enough for deflate to work with, little enough
/// to read for one bead or one frame.
H5md::Chunk final_chunk(const H5md& file) {
  constexpr std::uint64_t values = 8192;
  const auto points = std::clamp<std::uint64_t>(file.points(), 1, values);
  return {std::clamp<std::uint64_t>(values / points, 1, std::max<std::uint64_t>(file.frames(), 1)), points,
          true};
}

}  // namespace

std::uint64_t points_of_growing_chunk(std::uint64_t points) {
  constexpr std::uint64_t small = 256, large = 8192;
  return points > points_at_once ? large : small;
}

H5mdTrajectory::H5mdTrajectory(const fs::path& path, H5md::Content content, OutputFile::Existing existing,
                               RowSharing chunks_shared)
    : path_(path), content_(std::move(content)), chunks_shared_(std::move(chunks_shared)) {
  if (existing == OutputFile::Existing::resume) return;
  std::error_code error;
  if (existing == OutputFile::Existing::keep && fs::exists(path_, error)) throw exists_already(path_);
  if (!path_.parent_path().empty()) fs::create_directories(path_.parent_path(), error);
  if (error) throw FileError(fmt::format("{}: {}", path_.parent_path().string(), error.message()));
  fs::remove(twin(), error);
  H5md(twin(), content_, growing_chunk(0)).close();
  put_in_place(twin(), path_);
}

H5mdTrajectory::~H5mdTrajectory() {
  try {
    flush();
  } catch (const std::exception&) {
    // if it is this file that the run has failed over, it has been told
  }
  std::error_code error;
  fs::remove(twin(), error);  // the file is whole without it, and a full disk has better use for its room
}

fs::path H5mdTrajectory::twin() const {
  return path_.string() + ".next";
}

/// The chunks of a file are for good: with its first frame it is made anew if these are not for such a jet.
void H5mdTrajectory::begin_with(std::uint64_t points) {
  const H5md::Chunk chunk = growing_chunk(points);
  if (chunk.points == growing_chunk(0).points) return;
  flush();
  rewrite(chunk);
}

void H5mdTrajectory::append(Frame frame) {
  if (frames_ == 0) begin_with(frame.points());
  frame.step = static_cast<std::int64_t>(frames_++);
  add_grid(frame.time, frame.points());
  pending_.frames.push_back(std::move(frame));
  flush_if_due();
}

void H5mdTrajectory::append(Row row) {
  row.step = static_cast<std::int64_t>(rows_++);
  pending_.rows.push_back(std::move(row));
  flush_if_due();
}

void H5mdTrajectory::append(double time, std::uint64_t points, const Parts& parts) {
  if (frames_ == 0) begin_with(points);
  flush();
  bring_twin_up_to_date();
  H5md file(twin(), Hdf5File::Access::append);
  file.begin_frame(static_cast<std::int64_t>(frames_), time, points);
  parts([&file](const Frame& part) { file.append_part(part); });
  file.close();
  exchange_with_twin();
  behind_ = {};
  last_is_behind_ = twin_;
  ++frames_;
  add_grid(time, points);
  write_xdmf();
}

void H5mdTrajectory::add_grid(double time, std::uint64_t points) {
  points_ = std::max(points_, points);
  xdmf_.add({time, points});
}

void H5mdTrajectory::flush_if_due() {
  const std::size_t most = pending_.frames.size() * points_;
  if (Clock::now() >= next_flush_ || pending_.frames.size() >= most_pending || most >= most_pending_points)
    flush();
}

void H5mdTrajectory::flush() {
  if (pending_.frames.empty() && pending_.rows.empty()) return;
  const auto begin = Clock::now();
  bring_twin_up_to_date();
  exchange_with_twin();
  behind_ = std::exchange(pending_, {});
  write_xdmf();
  const auto end = Clock::now();
  next_flush_ = end + flush_share * (end - begin);
}

void H5mdTrajectory::bring_twin_up_to_date() {
  std::error_code error;
  if (!twin_ || in_use(twin())) {
    fs::remove(twin(), error);
    fs::copy_file(path_, twin(), error);
    if (error) throw FileError(fmt::format("{}: cannot be copied: {}", path_.string(), error.message()));
    behind_ = {};
    last_is_behind_ = false;
  }
  twin_ = false;  // until it is whole again: what a failure leaves half written is not gone on with
  H5md file(twin(), Hdf5File::Access::append);
  if (std::exchange(last_is_behind_, false)) {
    const H5md whole(path_, Hdf5File::Access::read);
    file.copy_frame(whole, whole.frames() - 1);
  }
  for (const Samples* samples : {&behind_, &pending_}) {
    file.append(samples->frames);
    file.append(samples->rows);
  }
  file.close();
}

/// At any instant there is a whole file under the name of the trajectory.
void H5mdTrajectory::exchange_with_twin() {
  const fs::path old = path_.string() + ".old";
  std::error_code error;
  fs::remove(old, error);
  fs::create_hard_link(path_, old, error);
  if (error == std::errc::no_such_file_or_directory)
    throw FileError(fmt::format("{}: has been removed while the run was writing it", path_.string()));
  twin_ = !error;  // a file system without hard links gets a copy each time
  put_in_place(twin(), path_);
  if (twin_) put_in_place(old, twin());
}

void H5mdTrajectory::write_xdmf() const {
  write_whole(fs::path(path_).replace_extension(".xdmf"),
              xdmf_.text(path_.filename().string(), points_, frame_columns(content_.added)));
}

void H5mdTrajectory::sync() {
  flush();
  force_to_disk(path_);
  force_to_disk(path_.has_parent_path() ? path_.parent_path() : ".");
}

void H5mdTrajectory::finish() {
  flush();
  rewrite(final_chunk(H5md(path_, Hdf5File::Access::read)));
  write_xdmf();
}

void H5mdTrajectory::continue_from(std::uint64_t frames, std::uint64_t rows) {
  pending_ = behind_ = {};
  last_is_behind_ = false;
  frames_ = frames;
  rows_ = rows;
  rewrite(growing_chunk(H5md(path_, Hdf5File::Access::read).points()));
  write_xdmf();
}

/// Puts the frames and rows so far, all of which are in the file, into a new one that takes its place.
void H5mdTrajectory::rewrite(const H5md::Chunk& chunk) {
  std::error_code error;
  fs::remove(twin(), error);
  twin_ = false;
  const H5md file(path_, Hdf5File::Access::read);
  if (file.frames() < frames_ || file.rows() < rows_)
    throw FileError(fmt::format("{}: expected {} frames and {} rows, found {} and {}", path_.string(),
                                frames_, rows_, file.frames(), file.rows()));
  // whole chunks, so that none is compressed twice
  const std::uint64_t at_once = chunk.compressed ? chunk.frames : 64;
  H5md fresh(twin(), content_, chunk);
  fresh.share_chunks(chunks_shared_);
  xdmf_ = {};
  points_ = 0;
  const bool long_frames = file.points() > points_at_once;
  for (std::uint64_t i = 0; long_frames && i < frames_; ++i) {
    const auto [time, points] = fresh.copy_frame(file, i);
    add_grid(time, points);
  }
  for (std::uint64_t i = 0; !long_frames && i < frames_; i += at_once) {
    const std::vector<Frame> frames = file.frames(i, std::min(at_once, frames_ - i));
    for (const Frame& f : frames) add_grid(f.time, f.points());
    fresh.append(frames);
  }
  fresh.append(file.rows(0, rows_));
  fresh.close();
  put_in_place(twin(), path_);
}

}  // namespace treejet
