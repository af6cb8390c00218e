#pragma once
/// The values of an HDF5 dataset whose form has been found good (core/io/hdf5_file.hpp), read and written as
/// numbers of one type. Those of chunks that are not there are `absent`.

#include <filesystem>
#include <span>
#include <string>

#include "core/base/row_sharing.hpp"
#include "core/io/chunks.hpp"
#include "core/io/hdf5_handle.hpp"

namespace treejet::hdf5 {

/// Of the whole table; none of one value.
Extent extent_of(Id set, const Checker& check);

template <class T>
class TableReader {
 public:
  TableReader(const std::filesystem::path& path, const std::string& name, Id set, Id type)
      : path_(path), name_(name), set_(set), type_(type), check_(path, name) {}

  /// In one piece if there are no chunks.
  void read_plain(const TableBox& box, const Extent& chunk, T* values, T absent) const;
  /// Chunks of so many bytes before the filters.
  void read_filtered(const TableBox& box, const Extent& chunk, std::span<const ChunkFilter> filters,
                     std::uint64_t length, T* values, T absent) const;

 private:
  /// 0 if the chunk is not there.
  std::uint64_t chunk_bytes(const Extent& first) const;
  /// As it is in the file, and which filters it has not been through; empty if it is not there.
  std::string filtered(const Extent& first, unsigned& skipped) const;

  const std::filesystem::path& path_;
  const std::string& name_;
  Id set_, type_;
  Checker check_;
};

template <class T>
class TableWriter {
 public:
  TableWriter(const std::filesystem::path& path, const std::string& name, Id set, Id type)
      : set_(set), type_(type), check_(path, name) {}

  void write_plain(const TableBox& box, const T* values) const;
  /// Whole chunks, but at the end of the table, where they are filled up with `absent`. They go through the
  /// filters at the same time and into the file one by one, so its bytes are the same whoever works.
  void write_filtered(const TableBox& box, const Extent& chunk, std::span<const ChunkFilter> filters,
                      const RowSharing& chunks_shared, const T* values, T absent) const;

 private:
  Id set_, type_;
  Checker check_;
};

extern template class TableReader<double>;
extern template class TableReader<std::int64_t>;
extern template class TableWriter<double>;
extern template class TableWriter<std::int64_t>;

}  // namespace treejet::hdf5
