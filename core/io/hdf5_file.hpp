#pragma once
/// An HDF5 file. The only place that knows the HDF5 library: writing is in hdf5_file.cpp, reading in
/// hdf5_reading.cpp and hdf5_table.cpp.
///
/// Objects are named by their full path, "/particles/jet/position/value". Datasets hold doubles or 64-bit
/// integers, are chunked, may be shuffled and deflated, and may grow in every dimension. Nothing in a file
/// depends on clock or user (objects carry no times), so the same calls make the same bytes. Files are of the
/// oldest format, which every tool reads and which, unlike the newer ones, has no mark "open for writing"
/// that would lock out readers after a death of the program. They are consistent once closed, not before:
/// core/io/h5md_trajectory.hpp says how a run lives with that.
///
/// HDF5 1.10 reads beyond its own memory where a file claims more than it holds. So the header of a dataset
/// is looked at before it is opened (core/io/object_header.hpp), then its type, layout and filters; chunks
/// that have been through filters are taken as they are and undone here (core/io/chunks.hpp), others are read
/// by their extent. Values of chunks that are not there are NaN or -1, whatever the file would fill in.
///
/// Errors are FileErrors that name file and object, with the reason of the system if there is one. HDF5's own
/// C interface and not its C++ one, which has no gain to show for a second library; HighFive is not in
/// Debian.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/row_sharing.hpp"
#include "core/io/chunks.hpp"
#include "core/io/object_header.hpp"

namespace treejet {

class Hdf5File {
 public:
  enum class Access { create, append, read };
  enum class Number { real, integer };
  struct Layout {
    Number number = Number::real;
    Extent extent, chunk;
    double fill = 0;
    bool compressed = true;
  };

  Hdf5File(std::filesystem::path path, Access access);
  /// Of what has not been closed by then nothing is promised.
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Everything to the system; the object is of no further use.
  void close();

  /// Each makes the groups above it.
  void group(const std::string& name);
  void dataset(const std::string& name, const Layout& layout);
  void text(const std::string& name, const std::string& value);
  /// A second name of an object.
  void link(const std::string& existing, const std::string& name);

  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, const std::vector<std::string>& values);
  /// As a string of variable length, which h5py and H5MD's readers take for text rather than for bytes.
  void word_attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, const std::vector<int>& values);

  bool has(const std::string& name) const;
  Extent extent(const std::string& dataset) const;
  std::string text(const std::string& dataset) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;

  void resize(const std::string& dataset, const Extent& extent);

  /// Who compresses.
  RowSharing chunks_shared = all_at_once;

  using Box = TableBox;
  void write(const std::string& dataset, const Box& box, const double* values);
  void write(const std::string& dataset, const Box& box, const std::int64_t* values);
  void read(const std::string& dataset, const Box& box, double* values) const;
  void read(const std::string& dataset, const Box& box, std::int64_t* values) const;

 private:
  using Id = std::int64_t;

  /// How the values of a dataset lie in the file.
  struct Stored {
    Extent chunk;  ///< none if they lie in one piece
    std::vector<ChunkFilter> filters;
    std::uint64_t chunk_bytes = 0;
  };

  struct Attribute {
    Id on_disk, space, in_memory;
    const void* values;
  };

  std::optional<HeaderPlace> find(const std::string& name) const;
  void put_attribute(const std::string& object, const std::string& name, const Attribute& a);
  Id open(const std::string& dataset) const;
  const Stored& stored(const std::string& dataset, Id set) const;
  template <class T>
  void write(const std::string& dataset, const Box& box, Id type, const T* values, T absent);
  template <class T>
  void read(const std::string& dataset, const Box& box, Id type, T* values, T absent) const;

  std::filesystem::path path_;
  Access access_;
  Id file_ = -1;
  mutable std::optional<HeaderPlace> root_;
  mutable std::map<std::string, Stored> stored_;  ///< of datasets that have been found good
  mutable std::set<std::string> groups_;          ///< that have been found good
};

/// Whether the file begins as an HDF5 file does.
bool is_hdf5(const std::filesystem::path& path);

/// The library's version, as it runs.
std::string hdf5_version();

}  // namespace treejet
