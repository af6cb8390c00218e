#pragma once
/// The values of an HDF5 dataset whose form has been found good (core/io/hdf5_file.hpp), read as numbers of
/// one type. Those of chunks that are not there are `absent`.

#include <filesystem>
#include <span>
#include <string>

#include "core/io/chunks.hpp"
#include "core/io/hdf5_handle.hpp"

namespace treejet::hdf5 {

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
  void select(Id space, const TableBox& part) const;
  /// 0 if the chunk is not there.
  std::uint64_t chunk_bytes(const Extent& first) const;
  /// As it is in the file, and which filters it has not been through; empty if it is not there.
  std::string filtered(const Extent& first, unsigned& skipped) const;

  const std::filesystem::path& path_;
  const std::string& name_;
  Id set_, type_;
  Checker check_;
};

extern template class TableReader<double>;
extern template class TableReader<std::int64_t>;

}  // namespace treejet::hdf5
