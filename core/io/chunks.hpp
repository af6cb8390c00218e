#pragma once
/// Tables that lie in a file in pieces of one extent, chunks, each of which has been through filters; and
/// what of a table is there at all. Nothing here knows HDF5, which takes on trust that a chunk is as long as
/// its extent says: core/io/hdf5_file.hpp asks here first.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace treejet {

using Extent = std::vector<std::uint64_t>;

/// A box of a table: its first corner and its size, row-major as in C.
struct TableBox {
  Extent first, size;
  bool operator==(const TableBox&) const = default;
};

/// In the order in which they are applied; shuffle keeps the length, fletcher32 appends four bytes.
enum class ChunkFilter { shuffle, deflate, fletcher32 };

/// How long a chunk is once its filters, without those that `skipped` has a bit for, are undone. None if they
/// cannot be, if it would be longer than `most`, or if a filter before deflate has to be undone behind it.
std::optional<std::uint64_t> unfiltered_length(std::string_view bytes, std::span<const ChunkFilter> filters,
                                               unsigned skipped, std::uint64_t most);

/// The parts of a box that lie in chunks of which `there` is true, in few pieces. It is asked once of each
/// chunk that the box touches, by the chunk's place among chunks.
std::vector<TableBox> parts_there(const TableBox& box, const Extent& chunk,
                                  const std::function<bool(const Extent& place)>& there);

}  // namespace treejet
