#pragma once
/// The layout of traj.h5: H5MD 1.1 (nongnu.org/h5md) with its module for units, in CGS.
///
///     /particles/jet/box                         dimension 3, boundary none
///     /particles/jet/{position,velocity,...}     one element for each of core/io/frame.hpp's columns; those
///                                                that the scene has added are named in /parameters/columns
///     /particles/jet/id                          bead number, 0 the nozzle, -1 (the fill value) no point
///     /observables/<key>                         core/deck/observable_keys.hpp
///     /parameters                                what made the file, core/io/provenance.hpp
///
/// An element is a group of step, time and value. All of the jet share one step and one time by hard links,
/// and so do all observables; a step counts frames, or rows. The number of points varies: values have as many
/// columns as the largest frame so far has points, and what is absent is NaN with id -1.
///
/// FileError if a file is no H5MD of ours, or cut short.

#include <map>
#include <span>
#include <utility>

#include "core/io/frame.hpp"
#include "core/io/hdf5_file.hpp"
#include "core/io/provenance.hpp"

namespace treejet {

class H5md {
 public:
  struct Content {
    Provenance made_by;
    std::vector<std::string> keys;                  ///< of the observables
    FrameColumns added = {};                        ///< columns of the scene
    std::map<std::string, std::string> units = {};  ///< of observables that are not in the table of keys
  };
  struct Chunk {
    std::uint64_t frames, points;
    bool compressed;
  };

  /// A file without frames.
  H5md(const std::filesystem::path& path, const Content& content, const Chunk& chunk);
  /// One that is there already; read or append.
  H5md(const std::filesystem::path& path, Hdf5File::Access access);

  void append(std::span<const Frame> frames);
  void append(std::span<const Row> rows);
  /// A frame of so many points, which then come in parts, oldest first.
  void begin_frame(std::int64_t step, double time, std::uint64_t points);
  void append_part(const Frame& part);
  /// A frame of another file, never the whole of it at once; returned are its time and points.
  std::pair<double, std::uint64_t> copy_frame(const H5md& from, std::uint64_t frame);
  void close() { file_.close(); }

  /// Who compresses.
  void share_chunks(const RowSharing& chunks_shared) { file_.chunks_shared = chunks_shared; }

  std::uint64_t frames() const { return frames_; }
  std::uint64_t rows() const { return rows_; }
  /// Of the largest frame.
  std::uint64_t points() const { return points_; }
  const Content& content() const { return content_; }
  const FrameColumns& columns() const { return columns_; }

  /// Of all frames, s.
  std::vector<double> times() const;
  std::vector<Frame> frames(std::uint64_t first, std::uint64_t count) const;
  /// So many points of a frame; fewer where it ends.
  Frame part(std::uint64_t frame, std::uint64_t first, std::uint64_t count) const;
  std::vector<Row> rows(std::uint64_t first, std::uint64_t count) const;

 private:
  void read_added_columns();
  void check_extents() const;
  void describe();
  void make_elements(const Chunk& chunk);
  std::uint64_t points_of(std::uint64_t frame) const;
  template <class T>
  void put(const std::string& element, const std::vector<T>& table, Extent size);

  Hdf5File file_;
  Content content_;
  FrameColumns columns_;
  std::uint64_t frames_ = 0, rows_ = 0, points_ = 0;
  std::uint64_t filled_ = 0;  ///< points of the frame begun last
};

}  // namespace treejet
