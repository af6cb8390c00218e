#pragma once
/// Tables that lie in a file in pieces of one extent, chunks, each of which has been through filters; and
/// what of a table is there at all. Nothing here knows HDF5, which takes on trust that a chunk is as long as
/// its extent says: core/io/hdf5_file.hpp asks here first.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treejet {

using Extent = std::vector<std::uint64_t>;

/// A box of a table: its first corner and its size, row-major as in C.
struct TableBox {
  Extent first, size;
  bool operator==(const TableBox&) const = default;
};

/// What is done to the bytes of a chunk before they are written: to bring together the first bytes of all
/// elements of `width`, then the second ones, and so on; to deflate; to append a checksum of four bytes.
struct ChunkFilter {
  enum class Kind { shuffle, deflate, fletcher32 } kind;
  std::uint64_t width = 1;
};

/// A chunk of `length` bytes before the filters were applied one by one, without those that `skipped` has a
/// bit for. None if its bytes are not that.
std::optional<std::string> unfiltered(std::string bytes, std::span<const ChunkFilter> filters,
                                      unsigned skipped, std::uint64_t length);

/// The level of deflate: higher ones gain a hundredth on trajectories.
inline constexpr unsigned deflate_level = 1;

/// What the filters make of the bytes of a chunk. Nothing is written with a checksum here.
std::string filtered(std::string bytes, std::span<const ChunkFilter> filters);

/// The parts of a box that lie in chunks of which `there` is true, in few pieces. It is asked once of each
/// chunk that the box touches, by the chunk's place among chunks.
std::vector<TableBox> parts_there(const TableBox& box, const Extent& chunk,
                                  const std::function<bool(const Extent& place)>& there);

/// The chunks that a box touches, by their place among chunks.
TableBox chunks_touched_by(const TableBox& box, const Extent& chunk);

/// Whether a box holds all that there is, in a table of that extent, of each chunk that it touches.
bool is_of_whole_chunks(const TableBox& box, const Extent& chunk, const Extent& table);

/// Which one a place is in a box, in the order of rows.
inline std::uint64_t number_in(const TableBox& box, const Extent& place) {
  std::uint64_t number = 0;
  for (std::size_t k = 0; k < place.size(); ++k) number = number * box.size[k] + place[k] - box.first[k];
  return number;
}

/// Calls `act` with each place in a box, in that order.
template <class Act>
void for_each_place(const TableBox& box, Act act) {
  if (std::find(box.size.begin(), box.size.end(), 0) != box.size.end()) return;
  Extent place = box.first;
  for (std::size_t k = place.size(); k > 0;) {
    act(place);
    for (k = place.size(); k > 0; --k) {
      if (++place[k - 1] < box.first[k - 1] + box.size[k - 1]) break;
      place[k - 1] = box.first[k - 1];
    }
  }
}

/// The values of a box of chunks.
TableBox values_of(TableBox chunks, const Extent& chunk);

/// What two boxes share; nothing along an axis on which they do not meet.
TableBox shared(const TableBox& a, const TableBox& b);

/// Copies the values that two boxes share from the table of the one to that of the other.
template <class T>
void copy_shared(const TableBox& from_box, const T* from, const TableBox& to_box, T* to) {
  TableBox rows = shared(from_box, to_box);
  const std::uint64_t row = std::exchange(rows.size.back(), std::min<std::uint64_t>(rows.size.back(), 1));
  for_each_place(rows, [&](const Extent& place) {
    std::copy_n(from + number_in(from_box, place), row, to + number_in(to_box, place));
  });
}

}  // namespace treejet
