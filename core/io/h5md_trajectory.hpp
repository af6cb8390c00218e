#pragma once
/// traj.h5 while it grows, with traj.xdmf beside it for ParaView.
///
/// Readable after any death of the program. An HDF5 file under change is consistent only by luck, and the
/// format's own remedy (SWMR) leaves a mark that h5py, h5dump and ParaView refuse until h5clear has removed
/// it. So traj.h5 is never written to: each flush brings a twin, traj.h5.next, up to date, closes it, and the
/// two change places by rename. The twin is two flushes behind then and gets what it lacks at the next. Where
/// a reader still holds the old file, it keeps it, and a copy becomes the twin.
///
/// The same bytes for the same frames, whenever it was flushed, interrupted or resumed: `finish` rewrites all
/// in one pass, with compressed chunks of many frames, and that is the file a completed run leaves. Until
/// then a frame is a chunk, and a flush is due when fifty times its own duration has passed, at a checkpoint,
/// and at the end.
///
/// A frame that is written part by part, as those of a jet in subdomains are, is flushed at once, and copied
/// part by part to the twin at the next flush.
///
/// Errors: FileError; what was flushed before stays.

#include <chrono>
#include <functional>

#include "core/base/output_file.hpp"
#include "core/io/h5md.hpp"
#include "core/io/xdmf.hpp"

namespace treejet {

/// Points of a chunk of a file that is still written, whose frames are whole chunks and not compressed.
std::uint64_t points_of_growing_chunk(std::uint64_t points_of_first_frame);

class H5mdTrajectory {
 public:
  /// A new one, without frames; or, to be resumed, the one that is there, whatever it holds: continue_from
  /// comes next.
  H5mdTrajectory(const std::filesystem::path& path, H5md::Content content, OutputFile::Existing existing,
                 RowSharing chunks_shared = all_at_once);
  /// Flushes what a run that has failed leaves.
  ~H5mdTrajectory();
  H5mdTrajectory(const H5mdTrajectory&) = delete;
  H5mdTrajectory& operator=(const H5mdTrajectory&) = delete;

  /// Sets step to the number of the frame, or row.
  void append(Frame frame);
  void append(Row row);
  /// A frame of so many points that nobody holds as a whole: its parts go straight to the file.
  using Parts = std::function<void(const std::function<void(const Frame& part)>& take)>;
  void append(double time, std::uint64_t points, const Parts& parts);

  /// All that has been appended is in the file.
  void flush();
  /// A flush that outlives the machine's.
  void sync();
  /// No more comes: the final form.
  void finish();

  std::uint64_t frames() const { return frames_; }
  std::uint64_t rows() const { return rows_; }
  /// Goes on after the first so many frames and rows of the file that is there, and forgets what follows.
  void continue_from(std::uint64_t frames, std::uint64_t rows);

 private:
  struct Samples {
    std::vector<Frame> frames;
    std::vector<Row> rows;
  };
  using Clock = std::chrono::steady_clock;

  std::filesystem::path twin() const;
  void add_grid(double time, std::uint64_t points);
  void flush_if_due();
  void bring_twin_up_to_date();
  void exchange_with_twin();
  void write_xdmf() const;
  void begin_with(std::uint64_t points);
  void rewrite(const H5md::Chunk& chunk);

  std::filesystem::path path_;
  H5md::Content content_;
  RowSharing chunks_shared_;
  Xdmf xdmf_;
  std::uint64_t frames_ = 0, rows_ = 0, points_ = 0;
  Samples pending_;              ///< not in the file
  Samples behind_;               ///< in the file, not in the twin
  bool last_is_behind_ = false;  ///< the file's last frame, which came in parts, is not in the twin
  bool twin_ = false;
  Clock::time_point next_flush_ = Clock::now();
};

}  // namespace treejet
